// The server on its sockets, as a program: valid and invalid requests.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <atomic>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "corpus/corpus.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "tests/corpus/temp_folder.h"
#include "tests/server/program.h"

namespace contort {
namespace {

using Json = nlohmann::json;

TEST(Serve, AnswersAndEndsWhenItIsTold) {
  Program server({});
  httplib::Client client = server.client();
  EXPECT_EQ(status(client.Get("/api/health")), 200);
  const auto document = client.Get("/api");
  ASSERT_TRUE(document);
  EXPECT_EQ(Json::parse(document->body)["openapi"], "3.1.0");
  EXPECT_EQ(document->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(server.end(SIGTERM), 0);
}

TEST(Serve, RefusesWhatDoesNotBelongHere) {
  Program server({});
  httplib::Client client = server.client();
  const auto get = [&](const std::string& path, const httplib::Headers& headers = {}) {
    return status(client.Get(path, headers));
  };
  EXPECT_EQ(get("/api/health", {{"Host", "evil.example"}}), 403);
  EXPECT_EQ(get("/api/health", {{"Origin", "http://evil.example"}}), 403);
  EXPECT_EQ(status(client.Post("/api/evaluate", kSpec, "text/plain")), 415);
  for (const char* path :
       {"/page/../../contort", "/page/%2e%2e/contort", "/page/..%2f..%2fcontort", "/report/../index.html",
        "/../../etc/passwd", "/page//etc/passwd", "/page/%00", "/page/..%5c..%5ccontort"}) {
    const std::string answer = raw(server.port(), "GET " + std::string(path) + " HTTP/1.1\r\nHost: 127.0.0.1:" +
                                                      std::to_string(server.port()) + "\r\nConnection: close\r\n\r\n");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 404") || answer.starts_with("HTTP/1.1 400")) << path << "\n" << answer;
  }
  EXPECT_EQ(get("/" + std::string(1500, 'a')), 414);
  EXPECT_EQ(get("/" + std::string(4000, 'a')), 414);
  EXPECT_EQ(status(client.Put("/api/health", "x", "text/plain")), 415);
  EXPECT_EQ(status(post(client, "/api/evaluate", std::string(2 << 20, 'x'))), 413);
  EXPECT_EQ(status(post(client, "/api/evaluate", std::string(400 << 10, 'x'))), 413);
  EXPECT_TRUE(server.lives());
}

TEST(Serve, TheTokenOpensItAndACookieKeepsItOpen) {
  Program server({"--token", "0123456789abcdefXYZ"});
  httplib::Client client = server.client();
  EXPECT_EQ(status(client.Get("/api/health")), 401);
  EXPECT_EQ(status(client.Get("/metrics")), 401);
  EXPECT_EQ(status(client.Get("/api/health", {{"Authorization", "Bearer 0123456789abcdefXYZ"}})), 200);
  const auto front = client.Get("/?token=0123456789abcdefXYZ");
  ASSERT_EQ(status(front), 302);
  const std::string cookie = front->get_header_value("Set-Cookie");
  EXPECT_NE(cookie.find("HttpOnly; SameSite=Strict"), std::string::npos);
  EXPECT_EQ(status(client.Get("/api/health", {{"Cookie", cookie.substr(0, cookie.find(';'))}})), 200);
}

int exit_code(const std::string& options) {
  const int status =
      std::system((std::string(CONTORT_BINARY_DIR "/contort serve ") + options + " 2>/dev/null >/dev/null").c_str());
  return WEXITSTATUS(status);
}

TEST(Serve, WhatCannotBeServedIsAnError) {
  EXPECT_EQ(exit_code("--host 0.0.0.0 --port 0"), 2) << "without a token";
  EXPECT_EQ(exit_code("--token short --port 0"), 2);
  EXPECT_EQ(exit_code("--token 'a b c d e f g h i j' --port 0"), 2);
  EXPECT_EQ(exit_code("--corpus /nowhere/at/all --read-only --port 0"), 2);
  EXPECT_EQ(exit_code("--port 70000"), 2);
  Program server({});
  EXPECT_EQ(exit_code("--port " + std::to_string(server.port())), 2) << "the port is taken";
}

// One list of specs through the calls and through the terminal.
TEST(Serve, MakesTheMotionsThatTheTerminalMakes) {
  Program server({});
  httplib::Client client = server.client();
  TempFolder folder;
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CONTORT_SOURCE_DIR "/docs/examples")) {
    if (entry.path().extension() != ".json") continue;
    const std::string text = slurp(entry.path().string());
    const auto answer = post(client, "/api/evaluate", R"({"spec":)" + text + "}");
    ASSERT_EQ(status(answer), 200) << entry.path() << (answer ? answer->body : "");
    const std::string out = folder / "motion.json";
    ASSERT_EQ(
        std::system(
            (CONTORT_BINARY_DIR "/contort generate " + entry.path().string() + " -o " + out + " > /dev/null").c_str()),
        0);
    EXPECT_EQ(Json::parse(answer->body)["motion_hash"], Json::parse(slurp(out))["motion_hash"]) << entry.path();
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

// Every documented call, once, with the ids of things that are there.
TEST(Serve, EveryDocumentedCallCanBeCalled) {
  TempFolder folder;
  ASSERT_TRUE(Corpus::create(folder / "corpus"));
  Program server({"--corpus", folder / "corpus"});
  httplib::Client client = server.client();
  const std::string broken =
      R"({"format":"contort.spec/1","character":{"name":"human"},"sequences":[{"clips":[{"actions":[)"
      R"({"action":"pose","slot":"arm_left","params":{"elbow_deg":-40}}]}]}]})";
  const auto opened = post(client, "/api/sessions", R"({"spec":)" + broken + "}");
  ASSERT_EQ(status(opened), 201);
  const std::string session = Json::parse(opened->body)["session"];
  const std::string sequence = R"({"clips":[{"actions":[{"action":"crouch","slot":"waist","duration_frames":20}]}]})";
  std::string subject, check;
  for (int i = 0; i < 1200 && check.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const Json findings =
        Json::parse(client.Get("/api/sessions/" + session)->body)["findings"].value("kinematic", Json::array());
    if (!findings.empty()) check = findings[0]["check"], subject = findings[0]["subject"];
  }
  std::map<std::string, std::string> bodies = {
      {"post_libraries", R"({"files":{"a.json":{"format":"contort.action/1"}}})"},
      {"post_evaluate", R"({"spec":)" + kSpec + "}"},
      {"post_generate", R"({"spec":)" + kSpec + "}"},
      {"post_sessions", R"({"spec":)" + kSpec + "}"},
      {"post_sessions_session_enqueue", R"({"sequence":)" + sequence + "}"},
      {"post_sessions_session_interrupt", R"({"sequence":)" + sequence + "}"},
      {"post_sessions_session_aim", R"({"slot":"head","action":"look_at","target_m":[0,1,3]})"},
      {"post_sessions_session_push", R"({"slot":"torso","impulse_N_s":[5,0,0]})"},
      {"post_sessions_session_clock", R"({"step":1})"},
      {"post_sessions_session_change", R"({"modes":["kinematic"]})"},
      {"post_sessions_session_case", Json{{"check", check}, {"subject", subject}, {"mode", "kinematic"}}.dump()},
      {"post_corpus_bucket_acknowledge", R"({"owner":"ana","ticket":"1"})"},
      {"post_corpus_bucket_quarantine", R"({"owner":"ana","reason":"x","expires":"2020-01-01"})"},
      {"post_corpus_bucket_note", R"({"text":"hello"})"}};
  const std::map<std::string, int> others = {{"post_libraries", 422}, {"post_corpus_bucket_quarantine", 422}};
  std::string bucket, job = "1";
  const Json document = Json::parse(client.Get("/api")->body);
  // The finding is stored first, then come calls that change the take, and the session ends last.
  std::vector<std::tuple<int, std::string, std::string, std::string>> calls;
  for (const auto& [path, methods] : document["paths"].items())
    for (const auto& [method, call] : methods.items()) {
      const std::string name = call["operationId"];
      const int order = name == "post_sessions_session_case" ? 0 : method == "delete" ? 2 : 1;
      calls.emplace_back(order, path, method, name);
    }
  std::ranges::sort(calls);
  ASSERT_GT(calls.size(), 25u);
  for (auto [order, path, method, name] : calls) {
    for (const auto& [id, value] :
         {std::pair("{session}", session), std::pair("{bucket}", bucket), std::pair("{job}", job)})
      if (const std::size_t at = path.find(id); at != std::string::npos) path.replace(at, std::strlen(id), value);
    const bool streams = name.ends_with("stream") || name.ends_with("events");
    int pieces = 0;
    httplib::Client one = server.client();
    const auto receive = [&](const char*, std::size_t) { return ++pieces < 2 || !streams; };
    const httplib::Result result = method == "post"     ? post(one, path, bodies.contains(name) ? bodies[name] : "{}")
                                   : method == "delete" ? one.Delete(path)
                                   : streams            ? one.Get(path, receive)
                                                        : one.Get(path);
    const int found = status(result);
    if (streams) {
      EXPECT_GE(pieces, 2) << path;
    } else if (others.contains(name)) {
      EXPECT_EQ(found, others.at(name)) << name;
    } else {
      EXPECT_TRUE(found == 200 || found == 201 || found == 202) << name << " " << found << (result ? result->body : "");
    }
    if (name == "post_sessions_session_case" && result) bucket = Json::parse(result->body).value("bucket", "");
  }
}

// A write that was answered is on the disk, whenever the server is killed.
TEST(ServeSlow, NoAcknowledgedWriteIsLostByAKill) {
  TempFolder folder;
  ASSERT_TRUE(Corpus::create(folder / "corpus"));
  std::string bucket;
  std::mt19937 random(1);
  for (int round = 0; round < 12; ++round) {
    Program server({"--corpus", folder / "corpus", "--calls-per-second", "100000"});
    if (bucket.empty()) {
      httplib::Client client = server.client();
      const std::string broken =
          R"({"format":"contort.spec/1","character":{"name":"human"},"sequences":[{"clips":[{"actions":[)"
          R"({"action":"pose","slot":"arm_left","params":{"elbow_deg":-40}}]}]}]})";
      const std::string session =
          Json::parse(post(client, "/api/sessions", R"({"spec":)" + broken + "}")->body)["session"];
      const auto kept = post(client, "/api/sessions/" + session + "/case",
                             R"({"check":"joint_range","subject":"arm_left/elbow min","mode":"kinematic"})");
      ASSERT_EQ(status(kept), 201) << kept->body;
      bucket = Json::parse(kept->body)["bucket"];
    }
    std::atomic<int> acknowledged = -1, sent = -1;
    std::thread writer([&] {
      httplib::Client client = server.client();
      for (int i = 0; i < 100000; ++i) {
        sent = i;
        const auto answer = post(client, "/api/corpus/" + bucket + "/note",
                                 Json{{"text", std::to_string(round) + ":" + std::to_string(i)}}.dump());
        if (status(answer) != 200) return;
        acknowledged = i;
      }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(30 + random() % 300));
    server.end(SIGKILL);
    writer.join();
    const Result<Bucket> stored = read_bucket(folder / "corpus/buckets/" + bucket);
    ASSERT_TRUE(stored) << to_line(stored.issue());
    if (acknowledged < 0) continue;
    const int number = std::stoi(stored->note.substr(stored->note.find(':') + 1));
    EXPECT_EQ(stored->note.substr(0, stored->note.find(':')), std::to_string(round));
    EXPECT_GE(number, acknowledged) << "what was acknowledged is there";
    EXPECT_LE(number, sent);
  }
}

// 200 sessions, then 10,000 calls of all kinds by 8 threads: good ones, malformed, oversized, slow and aborted ones.
TEST(ServeSlow, StandsWhatItIsGiven) {
  TempFolder folder;
  ASSERT_TRUE(Corpus::create(folder / "corpus"));
  Program server({"--corpus", folder / "corpus", "--sessions-per-client", "256", "--calls-per-second", "100000",
                  "--streams-per-client", "64"});
  const long before = server.resident();
  std::vector<std::string> sessions;
  httplib::Client client = server.client();
  for (int i = 0; i < 200; ++i) {
    const auto opened = post(client, "/api/sessions", R"({"spec":)" + kSpec + "}");
    ASSERT_EQ(status(opened), 201) << i << (opened ? opened->body : "");
    sessions.push_back(Json::parse(opened->body)["session"]);
  }
  const long opened = server.resident();
  std::atomic<int> good = 0, refused = 0, lost = 0;
  const std::string host = "Host: 127.0.0.1:" + std::to_string(server.port()) + "\r\n";
  const auto count = [&](const httplib::Result& result, bool is_good) {
    if (!result) return void(++lost);
    if (result->status >= 500 && result->status != 503) ADD_FAILURE() << result->status << result->body;
    ++(is_good && result->status < 300 ? good : refused);
  };
  const auto one = [&](httplib::Client& http, std::mt19937& random) {
    const std::string session = "/api/sessions/" + sessions[random() % sessions.size()];
    switch (random() % 16) {
      case 0:
        return count(
            post(http, session + "/enqueue",
                 R"({"sequence":{"clips":[{"actions":[{"action":"crouch","slot":"waist","duration_frames":20}]}]}})"),
            true);
      case 1: return count(post(http, session + "/push", R"({"slot":"torso","impulse_N_s":[20,0,5]})"), true);
      case 2: return count(post(http, session + "/push", R"({"slot":"torso","impulse_N_s":[1e300,0,"x"]})"), false);
      case 3: return count(http.Get(session), true);
      case 4: return count(http.Get(session + "/frames?from=0&count=30"), true);
      case 5: return count(post(http, "/api/evaluate", "{\"spec\":" + std::string(random() % 300000, '[')), false);
      case 6: return count(post(http, "/api/evaluate", std::string(1100000, 'x')), false);
      case 7: return count(http.Get("/api/sessions/" + std::string(random() % 1000, 'f')), false);
      case 8: return void(raw(server.port(), "GARBAGE \x01\xff\r\n\r\n"));
      case 9:
        return void(
            raw(server.port(), "POST /api/evaluate HTTP/1.1\r\n" + host + "Content-Length: 99999\r\n\r\nshort", true));
      case 10: return void(raw(server.port(), "GET /api/catalogue HTTP/1.1\r\n" + host + "\r\n", true));
      case 11:
        return void(raw(server.port(),
                        "POST /api/evaluate HTTP/1.1\r\n" + host + "Content-Length: 99999999999999999999\r\n\r\n",
                        true));
      case 12: return count(http.Get("/metrics"), true);
      case 13: return count(post(http, session + "/clock", R"({"play":true})"), true);
      case 14: return count(http.Get("/api/health", {{"Host", "evil.example"}}), false);
      default: return count(http.Get("/api/corpus"), true);
    }
  };
  // A client that sends a byte a second must not keep others waiting.
  std::atomic<bool> over = false;
  std::vector<std::thread> threads;
  for (int t = 0; t < 16; ++t)
    threads.emplace_back([&] {
      while (!over) raw(server.port(), "GET /api/health HTT");
    });
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      std::mt19937 random(static_cast<unsigned>(t));
      httplib::Client http = server.client();
      for (int i = 0; i < 1250; ++i) one(http, random);
    });
  for (std::size_t t = 16; t < threads.size(); ++t) threads[t].join();
  over = true;
  for (std::size_t t = 0; t < 16; ++t) threads[t].join();
  ASSERT_TRUE(server.lives());
  EXPECT_EQ(status(client.Get("/api/health")), 200);
  EXPECT_EQ(lost, 0);
  EXPECT_GT(good, 2000);
  const long after = server.resident();
  std::printf("good %d, refused %d; resident %.0f MB at first, %.0f with 200 sessions, %.0f after 10,000 calls\n",
              good.load(), refused.load(), 1e-6 * static_cast<double>(before), 1e-6 * static_cast<double>(opened),
              1e-6 * static_cast<double>(after));
  EXPECT_LT(after, 4L << 30);
  EXPECT_EQ(server.end(SIGTERM), 0);
}

}  // namespace
}  // namespace contort
