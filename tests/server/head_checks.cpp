// The form of a request's head is strict, so that no proxy can disagree about where the request ends.
#include <gtest/gtest.h>

#include "server/head.h"
#include "server/request.h"

namespace contort::server {
namespace {

Result<Head> post(const std::string& headers) { return read_head("POST /api HTTP/1.1\r\n" + headers + "\r\n"); }

std::string code(const Result<Head>& head) { return head ? "" : head.issue().code; }

TEST(Head, SaysWhereTheBodyEnds) {
  const Result<Head> counted = post("Host: a\r\nContent-Length: 12\r\n");
  ASSERT_TRUE(counted);
  EXPECT_EQ(counted->body_bytes, 12u);
  EXPECT_FALSE(counted->is_chunked);
  const Result<Head> chunked = post("transfer-encoding:\tChunked \r\n");
  ASSERT_TRUE(chunked);
  EXPECT_TRUE(chunked->is_chunked);
  EXPECT_TRUE(chunked->has_body());
  const Result<Head> empty = post("");
  ASSERT_TRUE(empty);
  EXPECT_FALSE(empty->has_body());
  EXPECT_TRUE(read_head("HEAD / HTTP/1.1\r\n\r\n")->is_read_only);
}

TEST(Head, IsHandedOnWithNamesInLowerCase) {
  EXPECT_EQ(post("Host:  a b \r\nX-Y:\r\n")->text, "POST /api HTTP/1.1\r\nhost: a b\r\nx-y: \r\n\r\n");
}

TEST(Head, ThatTwoReadersCouldReadDifferentlyIsRefused) {
  for (const char* headers : {
           "Content-Length: 5\r\nContent-Length: 6\r\n",
           "Content-Length: 5\r\ncontent-length: 5\r\n",
           "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n",
           "Transfer-Encoding: chunked\r\nContent-Length: 5\r\n",
           "Transfer-Encoding: gzip, chunked\r\n",
           "Transfer-Encoding: identity\r\n",
           "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n",
           "Content-Length: +5\r\n",
           "Content-Length: -1\r\n",
           "Content-Length: 0x5\r\n",
           "Content-Length: 5, 5\r\n",
           "Content-Length: 5 5\r\n",
           "Content-Length: %35\r\n",
           "Content-Length:\r\n",
           "Content-Length: 99999999999999999999\r\n",
           "Content-Length : 5\r\n",
           "X: a\r\n Content-Length: 5\r\n",
           "X: a\nContent-Length: 5\r\n",
           "X: a\rContent-Length: 5\r\n",
           "X: a\x01\r\n",
           "X\r\n",
           ": a\r\n",
           "X Y: a\r\n",
           "Host: a\r\nHost: b\r\n",
           "Content-Type: application/json\r\nContent-Type: multipart/form-data\r\n",
           "Authorization: a\r\nAuthorization: b\r\n",
           "Content-Encoding: identity\r\nContent-Encoding: gzip\r\n",
           "Origin: a\r\nOrigin: b\r\n",
       }) {
    const Result<Head> head = post(headers);
    EXPECT_EQ(code(head), "call.bad_request") << headers;
    EXPECT_EQ(status_of(head.issue()), 400) << headers;
  }
  EXPECT_EQ(code(post(std::string("X: a\0b\r\n", 8))), "call.bad_request");
  EXPECT_EQ(code(post("Accept: a\r\nAccept: b\r\n")), "") << "lists may be split";
}

TEST(Head, HasABoundedNumberOfHeaders) {
  std::string some, more;
  for (std::size_t i = 0; i < kMostHeaders; ++i) some += "x: y\r\n";
  EXPECT_EQ(code(post(some)), "");
  const Result<Head> head = post(some + "x: y\r\n");
  EXPECT_EQ(code(head), "call.long_head");
  EXPECT_EQ(status_of(head.issue()), 431);
}

// The library would send as many copies of the answer as there are ranges, and compress with Brotli for a second.
TEST(Head, HasNoRangesAndNoCostlyCompression) {
  const auto seen = [](const std::string& headers) { return post(headers)->text.substr(20); };
  EXPECT_EQ(seen("Range: bytes=0-,0-\r\nIf-Range: x\r\n"), "\r\n");
  EXPECT_EQ(seen("Accept-Encoding: gzip, deflate, br\r\n"), "accept-encoding: gzip\r\n\r\n");
  EXPECT_EQ(seen("Accept-Encoding: br\r\n"), "\r\n");
  EXPECT_EQ(seen("Accept-Encoding: gzip;q=0, br\r\n"), "\r\n");
}

}  // namespace
}  // namespace contort::server
