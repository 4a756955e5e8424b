// The guard's decisions: allowed callers, and the files that they can read.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "server/allowance.h"
#include "server/files.h"
#include "server/guard.h"
#include "tests/corpus/temp_folder.h"

namespace contort::server {
namespace {

namespace fs = std::filesystem;

const GuardConfig kOpen{{"127.0.0.1:8080", "localhost:8080"}, ""};
const GuardConfig kClosed{{"127.0.0.1:8080"}, "0123456789abcdef"};

Request get(const std::string& path = "/api") {
  Request request;
  request.path = path, request.headers = {{"host", "127.0.0.1:8080"}};
  return request;
}

Request post() {
  Request request = get();
  request.method = "POST";
  request.headers["content-type"] = "application/json";
  return request;
}

std::string code(const Result<Done>& done) { return done ? "" : done.issue().code; }

TEST(Guard, LetsInWhoCallsTheServerByItsName) {
  EXPECT_EQ(code(admit(get(), kOpen)), "");
  EXPECT_EQ(code(admit(post(), kOpen)), "");
}

TEST(Guard, RefusesANameOfElsewhereThatResolvesHere) {
  for (const char* host :
       {"evil.example", "evil.example:8080", "127.0.0.1", "127.0.0.1:80", "", "127.0.0.1:8080.evil.example"}) {
    Request request = get();
    request.headers["host"] = host;
    EXPECT_EQ(code(admit(request, kOpen)), "guard.host") << host;
  }
  Request without = get();
  without.headers.clear();
  EXPECT_EQ(code(admit(without, kOpen)), "guard.host");
}

TEST(Guard, RefusesPagesOfOtherServers) {
  for (const char* origin :
       {"http://evil.example", "null", "http://localhost:8080", "http://127.0.0.1:8081", "https://127.0.0.1"}) {
    Request request = post();
    request.headers["origin"] = origin;
    EXPECT_EQ(code(admit(request, kOpen)), "guard.origin") << origin;
  }
  Request own = post();
  own.headers["origin"] = "http://127.0.0.1:8080";
  EXPECT_EQ(code(admit(own, kOpen)), "");
}

// The requests that a form of another page can send without asking first.
TEST(Guard, RefusesWritesThatAFormCouldSend) {
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x",
                           "application/json-seq", "application/jsonp", "text/plain; application/json"}) {
    Request request = post();
    request.headers["content-type"] = type;
    EXPECT_EQ(code(admit(request, kOpen)), "call.content_type") << type;
  }
  for (const char* type : {"application/json", "application/json; charset=utf-8", "Application/JSON ;charset=utf-8"}) {
    Request request = post();
    request.headers["content-type"] = type;
    EXPECT_EQ(code(admit(request, kOpen)), "") << type;
  }
  Request elsewhere = post();
  elsewhere.headers["sec-fetch-site"] = "cross-site";
  EXPECT_EQ(code(admit(elsewhere, kOpen)), "guard.origin");
}

TEST(Guard, WantsTheTokenWhereThereIsOne) {
  EXPECT_EQ(code(admit(get(), kClosed)), "guard.token");
  for (const char* wrong : {"Bearer ", "Bearer 0123456789abcde", "Bearer 0123456789abcdeg", "Bearer 0123456789abcdef0",
                            "0123456789abcdef"}) {
    Request request = get();
    request.headers["authorization"] = wrong;
    EXPECT_EQ(code(admit(request, kClosed)), "guard.token") << wrong;
  }
  Request bearer = get();
  bearer.headers["authorization"] = "Bearer 0123456789abcdef";
  EXPECT_EQ(code(admit(bearer, kClosed)), "");
  Request cookie = get();
  cookie.headers["cookie"] = "a=b; contort=0123456789abcdef; c=d";
  EXPECT_EQ(code(admit(cookie, kClosed)), "");
  cookie.headers["cookie"] = "xcontort=0123456789abcdef";
  EXPECT_EQ(code(admit(cookie, kClosed)), "guard.token");
  Request asked = get("/");
  asked.query["token"] = "0123456789abcdef";
  EXPECT_EQ(code(admit(asked, kClosed)), "") << "that sets the cookie";
  asked.path = "/api/corpus";
  EXPECT_EQ(code(admit(asked, kClosed)), "guard.token") << "addresses are written down in too many places";
}

TEST(Guard, RefusesBodiesThatWouldGrow) {
  for (const char* encoding : {"gzip", "deflate", "br", "x-gzip", "zstd", "gzip, br", "identity, gzip"}) {
    Request request = post();
    request.headers["content-encoding"] = encoding;
    const Result<Done> admitted = admit(request, kOpen);
    EXPECT_EQ(code(admitted), "call.content_encoding") << encoding;
    EXPECT_EQ(status_of(admitted.issue()), 415);
  }
  Request plain = post();
  plain.headers["content-encoding"] = "identity";
  EXPECT_EQ(code(admit(plain, kOpen)), "");
}

// A client without the token gets this refusal first, and learns nothing about the rest of the request.
TEST(Guard, AsksForTheTokenBeforeAllElse) {
  Request request = get();
  request.method = "POST";
  request.headers["content-encoding"] = "gzip";
  EXPECT_EQ(code(admit(request, kClosed)), "guard.token");
}

TEST(Guard, RefusesLongAddresses) { EXPECT_EQ(code(admit(get("/" + std::string(5000, 'a')), kOpen)), "call.too_long"); }

TEST(Allowance, RefillsAsTimeGoesBy) {
  Allowance calls(10, 3);
  const Time begin{};
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(calls.take("a", 1, begin));
  EXPECT_FALSE(calls.take("a", 1, begin));
  EXPECT_TRUE(calls.take("b", 1, begin)) << "others are not meant";
  EXPECT_TRUE(calls.take("a", 1, begin + std::chrono::milliseconds(110)));
  EXPECT_FALSE(calls.take("a", 1, begin + std::chrono::milliseconds(120)));
  EXPECT_DOUBLE_EQ(calls.left("a", begin + std::chrono::hours(1)), 3.0) << "a long pause gives no more than that";
}

TEST(Allowance, MayBeOwed) {
  Allowance cpu_s(0.5, 10);
  const Time begin{};
  cpu_s.spend("a", 12, begin);
  EXPECT_DOUBLE_EQ(cpu_s.left("a", begin), -2.0);
  EXPECT_DOUBLE_EQ(cpu_s.wait_s("a", begin), 4.0);
  EXPECT_DOUBLE_EQ(cpu_s.wait_s("a", begin + std::chrono::seconds(3)), 1.0);
  EXPECT_DOUBLE_EQ(cpu_s.wait_s("a", begin + std::chrono::seconds(5)), 0.0);
  EXPECT_DOUBLE_EQ(cpu_s.wait_s("b", begin), 0.0);
}

TEST(Allowance, ForgetsWhoHasAllOfItAndNobodyElse) {
  Allowance calls(1, 2);
  const Time begin{};
  calls.spend("busy", 2, begin);
  for (int i = 0; i < 5000; ++i) EXPECT_TRUE(calls.take("client " + std::to_string(i), 0, begin));
  EXPECT_FALSE(calls.take("busy", 1, begin));
}

class Folder : public testing::Test {
 protected:
  Folder() {
    fs::create_directories(folder / "page/sub");
    spill(folder / "secret.txt", "secret");
    spill(folder / "page/index.html", "page");
    spill(folder / "page/sub/a.png", "picture");
    spill(folder / "page/.hidden", "hidden");
    fs::create_symlink(folder / "secret.txt", folder / "page/link.txt");
    fs::create_directory_symlink(folder.path(), folder / "page/up");
    ::mkfifo((folder / "page/pipe").c_str(), 0600);
  }
  TempFolder folder;
};

TEST_F(Folder, PlainFilesBelowItAreRead) {
  EXPECT_EQ(*read_below(folder / "page", "index.html"), "page");
  EXPECT_EQ(*read_below(folder / "page", "sub/a.png"), "picture");
}

TEST_F(Folder, NothingElseIs) {
  for (const std::string path : {"../secret.txt", "sub/../../secret.txt", "sub/../index.html", "./index.html",
                                 "/etc/passwd", "", "sub", "sub/", "link.txt", "up/secret.txt", ".hidden", "pipe",
                                 "index.html/", "index.html/x", "..\\secret.txt", "none", "sub//a.png"}) {
    const Result<std::string> bytes = read_below(folder / "page", path);
    ASSERT_FALSE(bytes) << path;
    EXPECT_EQ(bytes.issue().code, "call.not_found") << path;
  }
  EXPECT_FALSE(read_below(folder / "page", std::string("index.html\0.png", 15)));
}

TEST_F(Folder, AFileIsReadPieceByPiece) {
  const Result<std::shared_ptr<PlainFile>> file = open_below(folder / "page", "sub/a.png");
  ASSERT_TRUE(file);
  EXPECT_EQ((*file)->left(), 7u);
  EXPECT_EQ((*file)->read(4), "pict");
  spill(folder / "page/sub/a.png", "pictu");  // another program cuts it meanwhile
  EXPECT_EQ((*file)->read(100), "u");
  EXPECT_EQ((*file)->left(), 0u);
  EXPECT_EQ((*file)->read(100), "");
}

}  // namespace
}  // namespace contort::server
