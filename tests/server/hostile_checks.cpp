// Clients that want the server to fetch more than they send, to wait for them, or to read another request than they
// show.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <span>

#include "corpus/corpus.h"
#include "renders/gzip.h"
#include "tests/corpus/temp_folder.h"
#include "tests/server/program.h"

namespace contort {
namespace {

using Json = nlohmann::json;

const std::string kToken = "0123456789abcdefXYZ";
const httplib::Headers kLetIn = {{"Authorization", "Bearer " + kToken}};
constexpr double kLittle_MB = 24.0;      // more than threads that wake up for the first time take
constexpr std::size_t kMuch = 64 << 20;  // bytes

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::string bomb() {
  const std::vector<std::byte> zeros(kMuch, std::byte{'0'});
  const std::vector<std::byte> small = gzipped(zeros);
  return std::string(reinterpret_cast<const char*>(small.data()), small.size());
}

TEST(HostileCalls, ABodyThatWouldInflateTakesNoMemory) {
  Program server({"--token", kToken});
  httplib::Client client = server.client();
  EXPECT_EQ(status(client.Get("/api/health", kLetIn)), 200);
  const std::string small = bomb();
  ASSERT_LT(small.size(), 256u << 10) << "within the limit of what is sent";
  const double before_MB = server.peak_MB();
  for (const char* encoding : {"gzip", "deflate", "br", "gzip, br"}) {
    httplib::Headers headers = {{"Content-Encoding", encoding}};
    EXPECT_EQ(status(post(client, "/api/evaluate", small, headers)), 401) << encoding;
    headers.insert(kLetIn.begin(), kLetIn.end());
    const httplib::Result refused = post(client, "/api/evaluate", small, headers);
    ASSERT_EQ(status(refused), 415) << encoding;
    EXPECT_EQ(Json::parse(refused->body)["code"], "call.content_encoding");
  }
  EXPECT_LT(server.peak_MB() - before_MB, kLittle_MB);
  EXPECT_EQ(status(client.Get("/api/health", kLetIn)), 200);
}

TEST(HostileCalls, AreRefusedBeforeTheirBodyIsSent) {
  Program server({"--token", kToken});
  const std::string known = "Authorization: Bearer " + kToken + "\r\n", json = "Content-Type: application/json\r\n";
  const std::vector<std::tuple<std::string, std::string, std::string>> calls = {
      {"POST /api/evaluate", json + "Content-Length: 1000\r\n", "401"},
      {"POST /api/evaluate", json + "Transfer-Encoding: chunked\r\n", "401"},
      {"POST /api/evaluate", json + "Content-Encoding: gzip\r\nContent-Length: 1000\r\n", "401"},
      {"POST /api/evaluate", "Content-Type: multipart/form-data; boundary=x\r\nContent-Length: 1000\r\n", "401"},
      {"POST /api/evaluate", known + "Content-Type: multipart/form-data; boundary=x\r\nContent-Length: 1000\r\n",
       "415"},
      {"POST /api/evaluate", known + "Content-Type: application/x-www-form-urlencoded\r\nContent-Length: 1000\r\n",
       "415"},
      {"POST /api/evaluate", known + json + "Content-Encoding: br\r\nContent-Length: 1000\r\n", "415"},
      {"POST /api/evaluate", known + json + "Content-Length: 300000\r\n", "413"},
      {"POST /api/evaluate", known + json + "Content-Length: 999999999999\r\n", "413"},
      {"POST /api/libraries", known + json + "Content-Length: 2000000\r\n", "413"},
      {"POST /api/evaluate", known + json + "Expect: 100-continue\r\nContent-Length: 300000\r\n", "413"},
      {"POST /api/evaluate", json + "Expect: 100-continue\r\nContent-Length: 1000\r\n", "401"},
      {"POST /api/nowhere", known + json + "Content-Length: 1000\r\n", "404"},
      {"POST /api/health", known + json + "Content-Length: 1000\r\n", "405"},
      {"PUT /api/health", known + json + "Content-Length: 1000\r\n", "405"},
      {"POST /api/evaluate", known + "Origin: http://evil.example\r\n" + json + "Content-Length: 1000\r\n", "403"},
  };
  for (const auto& [line, headers, expected] : calls) {
    const Caller caller(server.port());
    EXPECT_TRUE(caller.send(head_of(server.port(), line) + headers + "\r\n"));
    const std::string answer = caller.receive(4, "\"}");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 " + expected)) << line << "\n" << headers << answer;
    EXPECT_NE(answer.find("Connection: close"), std::string::npos) << answer;
  }
}

TEST(HostileCalls, ABodyInChunksHasTheSameLimit) {
  Program server({});
  httplib::Client client = server.client();
  EXPECT_EQ(status(client.Get("/api/health")), 200);
  const std::string head = head_of(server.port(), "POST /api/evaluate") + "Content-Type: application/json\r\n";
  const double before_MB = server.peak_MB();
  {
    const Caller caller(server.port());
    EXPECT_TRUE(caller.send(head + "Transfer-Encoding: chunked\r\n\r\n"));
    const std::string chunk = "100000\r\n" + std::string(1 << 20, ' ') + "\r\n";
    for (std::size_t sent = 0; sent < kMuch && caller.send(chunk);) sent += 1 << 20;
    EXPECT_TRUE(caller.receive(10, "\"}").starts_with("HTTP/1.1 413"));
  }
  EXPECT_LT(server.peak_MB() - before_MB, kLittle_MB);
  const std::string body = R"({"spec":)" + kSpec + "}";
  char size[20];
  std::snprintf(size, sizeof size, "%zx", body.size());
  const Caller caller(server.port());
  EXPECT_TRUE(caller.send(head + "Transfer-Encoding: chunked\r\n\r\n" + size + "\r\n" + body + "\r\n0\r\n\r\n"));
  EXPECT_TRUE(caller.receive(30, "motion_hash").starts_with("HTTP/1.1 200")) << "a small one is welcome";
}

TEST(HostileCalls, AHeadWithoutAnEndTakesNoMemory) {
  Program server({});
  EXPECT_EQ(status(server.client().Get("/api/health")), 200);
  const double before_MB = server.peak_MB();
  const std::string block(1 << 20, 'x');
  std::string lines;
  while (lines.size() < 1 << 20) lines += "a:b\r\n";
  for (const auto& [begin, endless] : {std::pair<std::string, std::string>("GET /", block),
                                       {head_of(server.port(), "GET /api/health") + "x: ", block},
                                       {head_of(server.port(), "GET /api/health"), lines}}) {
    const Caller caller(server.port());
    EXPECT_TRUE(caller.send(begin));
    for (std::size_t sent = 0; sent < kMuch && caller.send(endless);) sent += endless.size();
    const std::string answer = caller.receive(10, "\"}");
    EXPECT_TRUE(answer.empty() || answer.starts_with("HTTP/1.1 431")) << answer.substr(0, 300);
  }
  EXPECT_LT(server.peak_MB() - before_MB, kLittle_MB);
  const Caller caller(server.port());
  EXPECT_TRUE(caller.send(head_of(server.port(), "GET /api/health") + lines.substr(0, 5000) + "\r\n"));
  EXPECT_TRUE(caller.receive(10, "\"}").starts_with("HTTP/1.1 431"));
}

// 1,500 ranges of a page were 1.2 GB.
TEST(HostileCalls, RangesAreNotMultiplied) {
  Program server({});
  httplib::Client client = server.client();
  const httplib::Result plain = client.Get("/api");
  ASSERT_EQ(status(plain), 200);
  std::string ranges = "bytes=0-";
  for (int i = 0; i < 1500; ++i) ranges += ",0-";
  for (const std::string& range : {ranges, std::string("bytes=0-1"), std::string("nonsense")}) {
    const httplib::Result answer = client.Get("/api", {{"Range", range}});
    ASSERT_EQ(status(answer), 200);
    EXPECT_EQ(answer->body.size(), plain->body.size());
    EXPECT_EQ(answer->get_header_value("Accept-Ranges"), "none");
  }
}

TEST(HostileCalls, CannotHaveAnswersCompressedAtGreatCost) {
  Program server({});
  const httplib::Result answer = server.client().Get("/api", {{"Accept-Encoding", "gzip, deflate, br"}});
  ASSERT_EQ(status(answer), 200);
  EXPECT_EQ(answer->get_header_value("Content-Encoding"), "gzip");
}

TEST(HostileCalls, WhoAsksWhetherABodyIsWantedIsTold) {
  Program server({});
  const Caller caller(server.port());
  const std::string body = R"({"spec":)" + kSpec + "}";
  EXPECT_TRUE(caller.send(head_of(server.port(), "POST /api/evaluate") +
                          "Content-Type: application/json\r\nExpect: 100-continue\r\n" +
                          "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n"));
  EXPECT_EQ(caller.receive(10, "\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  EXPECT_TRUE(caller.send(body));
  EXPECT_TRUE(caller.receive(30, "motion_hash").starts_with("HTTP/1.1 200"));
}

// The second request would be the attacker's, in the connection of a proxy that other people share.
TEST(HostileCalls, CannotHideARequestInAnother) {
  Program server({});
  const std::string hidden = head_of(server.port(), "GET /api/catalogue") + "\r\n";
  const std::string post = head_of(server.port(), "POST /api/evaluate") + "Content-Type: application/json\r\n";
  const std::string length = "Content-Length: " + std::to_string(hidden.size()) + "\r\n";
  for (const std::string& outer : {
           post + length + "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
           post + "Content-Length: 0\r\n" + length + "\r\n",
           post + "Transfer-Encoding: xchunked\r\n\r\n",
           post + "Transfer-Encoding: gzip, chunked\r\n\r\n",
           post + "Transfer-Encoding : chunked\r\n\r\n",
           post + "X: y\n" + length + "\r\n",
           head_of(server.port(), "GET /api/health") + length + "\r\n",
           head_of(server.port(), "HEAD /api/health") + "Transfer-Encoding: chunked\r\n\r\n",
           head_of(server.port(), "DELETE /api/sessions/1") + "Transfer-Encoding: chunked\r\n\r\n",
           head_of(server.port(), "OPTIONS /api/health") + length + "\r\n",
           head_of(server.port(), "PRI /api/health") + length + "\r\n",
           head_of(server.port(), "POST /api/nowhere") + length + "\r\n",
       }) {
    const Caller caller(server.port());
    EXPECT_TRUE(caller.send(outer + hidden));
    const std::string answers = caller.receive(10);
    EXPECT_EQ(count(answers, "HTTP/1.1 "), 1) << outer << "\n" << answers.substr(0, 3000);
    EXPECT_EQ(answers.find("\"characters\""), std::string::npos) << outer;
  }
  const Caller caller(server.port());
  EXPECT_TRUE(caller.send(hidden + head_of(server.port(), "GET /api/health") + "Connection: close\r\n\r\n"));
  EXPECT_EQ(count(caller.receive(10), "HTTP/1.1 200"), 2) << "requests that are what they seem may follow each other";
}

// ---- waiting

// The other client asks while idle connections could not have ended by themselves: that takes ten seconds.
void expect_answer(const Program& server, unsigned from) {
  const Caller caller(server.port(), from);
  EXPECT_TRUE(caller.send(head_of(server.port(), "GET /api/health") + "\r\n"));
  EXPECT_TRUE(caller.receive(4, "\"ok\"").starts_with("HTTP/1.1 200")) << "from 127.0.0." << from;
}

std::vector<Caller> callers(const Program& server, int each, unsigned clients, const std::string& begin) {
  std::vector<Caller> all;
  for (unsigned client = 1; client <= clients; ++client)
    for (int i = 0; i < each; ++i) {
      all.emplace_back(server.port(), client);
      if (!begin.empty()) (void)all.back().send(begin);
    }
  return all;
}

TEST(HostileCalls, IdleConnectionsKeepNobodyOut) {
  Program server({});
  const std::vector<Caller> idle = callers(server, 200, 1, "");
  expect_answer(server, 2);
  expect_answer(server, 1);
  // Each connection's own thread takes its seat, so they come in almost the order of their calls; Connections.* tests
  // the choice among them.
  const auto over = std::ranges::count_if(idle, &Caller::is_over);
  EXPECT_GT(over, 0) << "some made room";
  EXPECT_LT(over, 200) << "there is room for others";
}

TEST(HostileCalls, IdleConnectionsOfManyClientsKeepNobodyOut) {
  Program server({});
  const std::vector<Caller> idle = callers(server, 40, 10, "");
  expect_answer(server, 20);
  expect_answer(server, 1);
}

TEST(HostileCalls, HalfARequestKeepsNobodyOut) {
  Program server({});
  const std::vector<Caller> slow = callers(server, 200, 1, "GET /api/health HTT");
  expect_answer(server, 2);
  expect_answer(server, 1);
}

TEST(HostileCalls, BodiesThatNeverComeKeepNobodyOut) {
  Program server({});
  const std::vector<Caller> slow = callers(
      server, 100, 1,
      head_of(server.port(), "POST /api/evaluate") + "Content-Type: application/json\r\nContent-Length: 100\r\n\r\n{");
  const std::vector<Caller> more = callers(server, 100, 1, "");
  expect_answer(server, 2);
  expect_answer(server, 1);
}

TEST(HostileCalls, WhoDripsAHeadIsGivenUp) {
  Program server({});
  const Caller caller(server.port());
  EXPECT_TRUE(caller.send(head_of(server.port(), "GET /api/health") + "x: "));
  std::string answer;
  for (int i = 0; i < 300 && answer.empty() && caller.send("y"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (i % 10 == 9) answer = caller.receive(0, "\r\n");
    if (caller.is_over()) break;
  }
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 408") || caller.is_over()) << answer;
}

TEST(HostileCalls, TheServerEndsAtOnceAlthoughSomebodyIsConnected) {
  Program server({});
  const std::vector<Caller> idle = callers(server, 20, 1, "");
  expect_answer(server, 2);
  const auto since = std::chrono::steady_clock::now();
  EXPECT_EQ(server.end(SIGTERM), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - since, std::chrono::seconds(8)) << "idle connections last for ten";
}

// ---- headers

// `answer` as it came, up to its empty line.
void expect_safe_headers(const std::string& answer, const std::string& about) {
  const std::string head = answer.substr(0, answer.find("\r\n\r\n") + 2);
  for (const char* line : {"X-Content-Type-Options: nosniff\r\n", "X-Frame-Options: DENY\r\n",
                           "Referrer-Policy: no-referrer\r\n", "Cross-Origin-Resource-Policy: same-origin\r\n"})
    EXPECT_EQ(count(head, line), 1) << about << "\n" << head;
  EXPECT_EQ(count(head, "Content-Security-Policy: default-src 'none'"), 1) << about << "\n" << head;
  EXPECT_EQ(count(head, "frame-ancestors 'none'"), 1) << about << "\n" << head;
  EXPECT_EQ(head.find("unsafe"), std::string::npos) << about << "\n" << head;
}

TEST(HostileCalls, NoAnswerMayBeFramedOrTakenForSomethingElse) {
  TempFolder folder;
  ASSERT_TRUE(Corpus::create(folder / "corpus"));
  Program server({"--corpus", folder / "corpus"});
  httplib::Client client = server.client();
  for (int i = 0; i < 600 && status(client.Get("/report/index.html")) != 200; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const std::string host = std::to_string(server.port()), json = "Content-Type: application/json\r\n";
  const std::vector<std::pair<std::string, std::string>> requests = {
      {"200", head_of(server.port(), "GET /report/index.html") + "\r\n"},
      {"302", head_of(server.port(), "GET /") + "\r\n"},
      {"200", head_of(server.port(), "GET /api") + "\r\n"},
      {"200", head_of(server.port(), "HEAD /api") + "\r\n"},
      {"200", head_of(server.port(), "OPTIONS /api") + "\r\n"},
      {"200", head_of(server.port(), "GET /metrics") + "\r\n"},
      {"200", head_of(server.port(), "GET /api/events") + "\r\n"},
      {"404", head_of(server.port(), "GET /page/none.js") + "\r\n"},
      {"404", head_of(server.port(), "GET /<script>alert(1)</script>") + "\r\n"},
      {"400", "NONSENSE / HTTP/1.1\r\n\r\n"},
      {"400", "GET / HTTP/9.9\r\n\r\n"},
      {"400", head_of(server.port(), "GET /") + "a b\r\n\r\n"},
      {"400", head_of(server.port(), "POST /api/evaluate") + json + "Content-Length: 1\r\n\r\n{"},
      {"403", "GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"},
      {"405", head_of(server.port(), "TRACE /api") + "\r\n"},
      {"413", head_of(server.port(), "POST /api/evaluate") + json + "Content-Length: 9999999\r\n\r\n"},
      {"414", head_of(server.port(), "GET /" + std::string(3000, 'a')) + "\r\n"},
      {"414", head_of(server.port(), "GET /" + std::string(9000, 'a')) + "\r\n"},
      {"415", head_of(server.port(), "POST /api/evaluate") + "Content-Length: 1\r\n\r\n{"},
      {"431", head_of(server.port(), "GET /" + std::string(40000, 'a')) + "\r\n"},
  };
  for (const auto& [expected, request] : requests) {
    const Caller caller(server.port());
    EXPECT_TRUE(caller.send(request));
    const std::string answer = caller.receive(10, "\r\n\r\n");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 " + expected)) << request.substr(0, 200) << "\n" << answer.substr(0, 500);
    expect_safe_headers(answer, request.substr(0, 100));
    EXPECT_EQ(answer.find("<script>alert"), std::string::npos) << "nothing of a request is in an answer";
  }
}

TEST(HostileCalls, WhatIsSaidOfAMethodIsWhatThereIs) {
  Program server({});
  httplib::Client client = server.client();
  const httplib::Result options = client.Options("/api/sessions/1");
  ASSERT_EQ(status(options), 200);
  EXPECT_EQ(options->get_header_value("Allow"), "GET, HEAD, DELETE, OPTIONS");
  EXPECT_FALSE(options->has_header("Access-Control-Allow-Origin"));
  EXPECT_EQ(status(client.Options("/api/nowhere")), 404);
  EXPECT_EQ(status(client.Options("/api", {{"Origin", "http://evil.example"}})), 403);
  const httplib::Result wrong = post(client, "/api/health", "{}");
  ASSERT_EQ(status(wrong), 405);
  EXPECT_EQ(wrong->get_header_value("Allow"), "GET, HEAD, OPTIONS");
  const httplib::Result head = client.Head("/api"), get = client.Get("/api");
  ASSERT_EQ(status(head), 200);
  EXPECT_EQ(head->get_header_value("Content-Length"), get->get_header_value("Content-Length"));
  EXPECT_EQ(head->body, "");
}

}  // namespace
}  // namespace contort
