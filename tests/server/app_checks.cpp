// The calls, without sockets.
#include <gtest/gtest.h>

#include <thread>

#include "corpus/bucket.h"
#include "server/routes.h"
#include "tests/server/app_fixture.h"

namespace contort::server {
namespace {

std::string open(const Server& server, const Json& spec, const Json& modes = Json::array()) {
  const Answer answer = server.post("/api/sessions", {{"spec", spec}, {"modes", modes}});
  EXPECT_EQ(answer.status, 201) << answer.body;
  return "/api/sessions/" + Json::parse(answer.body).value("session", "");
}

// All events of a stream until there is none for a moment.
std::vector<std::pair<std::string, Json>> listen(const Answer& stream, int pieces = 3) {
  std::string text;
  bool more = true;
  for (int i = 0; i < pieces && more; ++i) text += stream.pieces(more);
  std::vector<std::pair<std::string, Json>> events;
  for (std::size_t at = text.find("event: "); at != std::string::npos; at = text.find("event: ", at + 1)) {
    const std::size_t line = text.find('\n', at), data = line + 7, end = text.find('\n', data);
    events.emplace_back(text.substr(at + 7, line - at - 7), Json::parse(text.substr(data, end - data)));
  }
  return events;
}

Json last(const std::vector<std::pair<std::string, Json>>& events, const std::string& name) {
  Json found;
  for (const auto& [kind, data] : events)
    if (kind == name) found = data;
  return found;
}

// ---- sessions

// The law of sessions: the spec of a session makes the same motion again.
TEST(Sessions, TheSpecOfASessionMakesItsMotionAgain) {
  Server server;
  const std::string session = open(server, standing("mech", "dynamic"), {"dynamic", "kinematic"});
  EXPECT_EQ(server.post(session + "/enqueue", {{"sequence", sequence("walk", "waist", 60)}}).status, 200);
  EXPECT_EQ(server.post(session + "/clock", {{"step", 20}}).status, 200);
  EXPECT_EQ(server.post(session + "/aim", {{"slot", "head"}, {"action", "look_at"}, {"target_m", {1, 1.5, 4}}}).status, 200);
  EXPECT_EQ(server.post(session + "/clock", {{"step", 10}}).status, 200);
  EXPECT_EQ(server.post(session + "/push", {{"slot", "torso"}, {"impulse_N_s", {80, 0, 0}}}).status, 200);
  EXPECT_EQ(server.post(session + "/interrupt", {{"sequence", sequence("crouch", "waist", 30)}}).status, 200);
  const Json state = server.get(session);
  EXPECT_EQ(state["frame"], 30);
  for (const char* mode : {"dynamic", "kinematic"}) {
    Json spec = state["spec"];
    spec["dynamics"]["mode"] = mode;
    const Json again = Json::parse(server.post("/api/evaluate", {{"spec", spec}}).body);
    EXPECT_EQ(again["motion_hash"], state["motion_hashes"][mode]) << mode;
  }
}

TEST(Sessions, ARefusedCommandChangesNothing) {
  Server server;
  const std::string session = open(server, standing());
  const Json before = server.get(session);
  const std::vector<std::tuple<std::string, Json, int, std::string>> bad = {
      {"/enqueue", {{"sequence", sequence("fly", "waist", 60)}}, 422, "spec.unknown_action"},
      {"/enqueue", {{"sequence", sequence("walk", "tail", 60)}}, 422, "spec.unknown_slot"},
      {"/enqueue", {{"sequence", sequence("walk", "waist", 60)}, {"what", 1}}, 400, "call.unknown_field"},
      {"/push", {{"slot", "nose"}, {"impulse_N_s", {1, 0, 0}}}, 422, "dynamics.unknown_name"},
      {"/push", {{"slot", "torso"}, {"impulse_N_s", {1e9, 0, 0}}}, 400, "call.out_of_range"},
      {"/change", {{"character", {{"name", "unicorn"}}}}, 422, "character.unknown_character"},
      {"/change", {{"modes", Json::array()}}, 400, "call.no_mode"},
      {"/enqueue", {{"sequence", sequence("pose", "head", 36000)}}, 409, "take.too_long"}};
  for (const auto& [path, body, status, code] : bad) {
    const Answer answer = server.post(session + path, body);
    EXPECT_EQ(answer.status, status) << path << answer.body;
    EXPECT_EQ(code_of(answer), code) << path << answer.body;
  }
  EXPECT_EQ(server.get(session)["spec"], before["spec"]);
  EXPECT_EQ(server.get(session)["motion_hashes"], before["motion_hashes"]);
}

TEST(Sessions, OneDoesNotDisturbAnother) {
  Server server;
  const std::string a = open(server, standing()), b = open(server, standing());
  EXPECT_NE(a, b);
  const Json before = server.get(b);
  server.post(a + "/enqueue", {{"sequence", sequence("walk", "waist", 60)}});
  EXPECT_EQ(server.get(b)["motion_hashes"], before["motion_hashes"]);
  EXPECT_EQ(server.call("DELETE", a).status, 200);
  EXPECT_EQ(server.call("GET", a).status, 404);
  EXPECT_EQ(server.call("GET", b).status, 200);
}

TEST(Sessions, AStreamSendsTheMotionAndEveryChange) {
  Server server;
  const std::string session = open(server, standing());
  const Answer stream = server.call("GET", session + "/stream");
  ASSERT_TRUE(stream.pieces);
  const auto first = listen(stream);
  EXPECT_EQ(first[0].first, "take");
  EXPECT_EQ(last(first, "clock")["frame"], 0);
  EXPECT_EQ(last(first, "frames")["from"], 0);
  EXPECT_GT(last(first, "frames")["count"], 30);
  EXPECT_EQ(last(first, "margins")["findings"], Json::array());
  server.post(session + "/enqueue", {{"sequence", sequence("walk", "waist", 60)}});
  const auto second = listen(stream);
  EXPECT_EQ(last(second, "frames")["revision"], 2);
  EXPECT_LE(last(second, "frames")["from"], 2) << "from the first frame that differs";
  EXPECT_FALSE(last(second, "spans")["spans"].empty());
  server.call("DELETE", session);
  bool more = true;
  for (int i = 0; i < 5 && more; ++i) stream.pieces(more);
  EXPECT_FALSE(more) << "its end is the stream's end";
}

TEST(Sessions, TheNextTakeBeginsWhereTheFigureStands) {
  Limits limits;
  limits.take_s = 2.0;
  Server server(limits);
  Json spec = standing();
  spec["sequences"] = Json::array({sequence("walk", "waist", 58, {{"speed_m_s", 1.0}})});
  const std::string session = open(server, spec);
  server.post(session + "/clock", {{"play", true}});
  const Answer stream = server.call("GET", session + "/stream");
  for (int i = 0; i < 60 && server.get(session)["take"] == 1; ++i) listen(stream, 1);
  const Json state = server.get(session);
  EXPECT_EQ(state["take"], 2);
  EXPECT_TRUE(state["playing"]);
  EXPECT_GT(state["spec"]["start"]["position_m"][2], 0.1) << state["spec"];
  EXPECT_EQ(state["spec"]["character"]["name"], "mech");
  EXPECT_EQ(last(listen(stream, 2), "frames")["take"], 2);
}

TEST(Sessions, AnotherPartIsANewTakeOnTheSpot) {
  Server server;
  const std::string session = open(server, standing());
  const Json model = server.get(session + "/model");
  const Answer answer =
      server.post(session + "/change", {{"character", {{"name", "mech"}, {"parts", {{"arm_right", "mech_arm_shield"}}}}}});
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(Json::parse(answer.body)["take"], 2);
  EXPECT_EQ(Json::parse(answer.body)["model"], 2);
  EXPECT_NE(server.get(session + "/model")["joints"], model["joints"]);
}

TEST(Sessions, FramesAreThoseOfTheGlb) {
  Server server;
  const std::string session = open(server, standing());
  const std::size_t joints = server.get(session + "/model")["joints"].size();
  const Answer frames = server.call("GET", session + "/frames?from=3&count=2");
  EXPECT_EQ(frames.body.size(), 2 * joints * kJointBytes);
  EXPECT_EQ(server.call("GET", session + "/frames?from=x").status, 400);
  EXPECT_EQ(server.call("GET", session + "/frames?mode=dynamic").status, 400);
  EXPECT_EQ(server.call("GET", session + "/frames?from=999999").body, "");
  EXPECT_EQ(server.call("GET", session + "/motion.glb").body.substr(0, 4), "glTF");
}

TEST(Sessions, LimitsAreKept) {
  Limits limits;
  limits.sessions_of_client = 2, limits.streams_of_client = 1;
  Server server(limits);
  const std::string first = open(server, standing());
  open(server, standing());
  const Answer third = server.post("/api/sessions", {{"spec", standing()}});
  EXPECT_EQ(third.status, 429);
  EXPECT_EQ(code_of(third), "limit.sessions");
  const Answer stream = server.call("GET", first + "/stream");
  EXPECT_EQ(server.call("GET", first + "/stream").status, 429);
  server.app->sessions().sweep(std::chrono::steady_clock::now() + std::chrono::hours(1));
  EXPECT_EQ(server.app->sessions().count(), 0) << "nobody used them";
  EXPECT_EQ(server.post("/api/sessions", {{"spec", standing()}}).status, 201);
}

TEST(Calls, AreLimitedByTheirRate) {
  Limits limits;
  limits.calls_per_s = 1, limits.calls_at_once = 5;
  Server server(limits, false);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(server.call("GET", "/api/health").status, 200);
  const Answer refused = server.call("GET", "/api/health");
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(refused.headers[0].first, "Retry-After");
}

// The cost of a motion is known only after it was made, so the next one waits.
TEST(Cpu, IsLimitedForEachClient) {
  Limits limits;
  limits.cpu_s_per_minute = 0.0006, limits.cpu_minutes_at_once = 0.1;  // less than any evaluation takes
  Server server(limits, false);
  const Json body = {{"spec", standing("mech", "dynamic")}};
  EXPECT_EQ(server.post("/api/evaluate", body).status, 200);
  const Answer refused = server.post("/api/evaluate", body);
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(code_of(refused), "limit.cpu");
  EXPECT_EQ(refused.headers[0].first, "Retry-After");
  EXPECT_GT(std::stoi(refused.headers[0].second), 1) << refused.body;
  EXPECT_EQ(server.call("GET", "/api/catalogue").status, 200) << "what generates nothing";
  server.client = "127.0.0.2";
  EXPECT_EQ(server.post("/api/evaluate", body).status, 200);
}

// Without CPU time the figure stands still at the end of its take, and continues on request when there is time again.
TEST(Cpu, ASessionGoesOnWhenThereIsSomeAgain) {
  Server server;
  const std::string session = open(server, standing());
  server.engine->spend(server.client, 1e3);
  EXPECT_EQ(server.post(session + "/clock", {{"step", 36000}}).status, 200);
  EXPECT_EQ(server.post(session + "/clock", {{"play", true}}).status, 200);
  const Answer stream = server.call("GET", session + "/stream");
  EXPECT_EQ(last(listen(stream), "problem")["code"], "limit.cpu");
  EXPECT_EQ(server.get(session)["take"], 1);
  server.engine->spend(server.client, -1e3);
  EXPECT_EQ(server.post(session + "/clock", {{"play", true}}).status, 200);
  listen(stream);
  EXPECT_EQ(server.get(session)["take"], 2);
}

TEST(Cpu, OfWhatEndedBadlyCountsToo) {
  BrokerLimits workers;
  workers.each.seconds = 0.1;
  Limits limits;
  limits.cpu_s_per_minute = 0.06, limits.cpu_minutes_at_once = 1;
  Server server(limits, false, false, workers);
  Json long_one = standing("mech", "dynamic", 240);
  long_one["sequences"] = Json::array({sequence("crouch", "waist", 14000)});
  const Answer too_long = server.post("/api/evaluate", {{"spec", long_one}});
  EXPECT_EQ(code_of(too_long), "work.timeout") << too_long.body;
  EXPECT_EQ(code_of(server.post("/api/evaluate", {{"spec", standing("human")}})), "limit.cpu");
}

TEST(Calls, ThatDoNotExistAreRefused) {
  Server server({}, false);
  EXPECT_EQ(server.call("GET", "/api/nothing").status, 404);
  EXPECT_EQ(server.call("POST", "/api/catalogue", "{}").status, 405);
  EXPECT_EQ(server.call("GET", "/api/sessions//push").status, 404);
  EXPECT_EQ(server.call("GET", "/api/").status, 404);
  EXPECT_EQ(server.post("/api/evaluate", {{"spec", standing("mech")}, {"x", std::string(300 << 10, 'x')}}).status, 413);
  EXPECT_EQ(server.call("POST", "/api/evaluate", "{").status, 400);
  EXPECT_EQ(server.call("GET", "/api/corpus").status, 404);
  EXPECT_EQ(server.call("GET", "/report/index.html").status, 404);
}

TEST(Calls, ARegisteredLibraryCanBeUsed) {
  Server server;
  const std::string folder = CONTORT_SOURCE_DIR "/docs/examples/own_actions";
  Json files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") files[entry.path().filename().string()] = Json::parse(slurp(entry.path().string()));
  const Answer answer = server.post("/api/libraries", {{"files", files}});
  ASSERT_EQ(answer.status, 201) << answer.body;
  const std::string library = Json::parse(answer.body)["library"];
  EXPECT_EQ(server.post("/api/evaluate", {{"spec", standing()}, {"library", library}}).status, 200);
  EXPECT_EQ(server.post("/api/evaluate", {{"spec", standing()}, {"library", "none"}}).status, 404);
  const Answer bad = server.post("/api/libraries", {{"files", {{"../../x.json", {{"format", "contort.part/1"}}}}}});
  EXPECT_EQ(bad.status, 422) << bad.body;
  EXPECT_EQ(bad.body.find("/tmp"), std::string::npos) << bad.body;
}

// ---- the corpus

// A pose beyond the limits of a joint.
Json broken() {
  Json spec = standing("human");
  spec["sequences"] = Json::array({sequence("pose", "arm_left", 20, {{"elbow_deg", -40}})});
  return spec;
}

std::string keep(const Server& server) {
  const std::string session = open(server, broken());
  Json findings;
  for (int i = 0; i < 1200 && findings.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    findings = server.get(session)["findings"].value("kinematic", Json::array());
  }
  EXPECT_FALSE(findings.empty());
  const Answer answer = server.post(session + "/case", {{"check", findings[0]["check"]}, {"subject", findings[0]["subject"]}, {"mode", "kinematic"}});
  EXPECT_EQ(answer.status, 201) << answer.body;
  return Json::parse(answer.body).value("bucket", "");
}

Json wait_for(const Server& server, const Answer& started) {
  EXPECT_EQ(started.status, 202) << started.body;
  Json job = Json::parse(started.body);
  for (int i = 0; i < 3000 && (job["state"] == "queued" || job["state"] == "running"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    job = server.get("/api/jobs/" + job["job"].get<std::string>());
  }
  return job;
}

TEST(Triage, WhatASessionShowsCanBeKeptShrunkReplayedAndAcknowledged) {
  Server server;
  const std::string raw = keep(server);
  const Json shrunk = wait_for(server, server.post("/api/corpus/" + raw + "/shrink", Json::object()));
  ASSERT_EQ(shrunk["state"], "done") << shrunk;
  const std::string bucket = "/api/corpus/" + shrunk["result"]["bucket"].get<std::string>();
  const Json shown = server.get(bucket);
  EXPECT_LE(shown["cases"]["min"]["spec"].dump().size(), shown["cases"]["orig"]["spec"].dump().size());
  EXPECT_EQ(server.get("/api/corpus")["buckets"].size(), 1u) << "the raw one is gone, or is the same";
  const Json replayed = wait_for(server, server.post(bucket + "/replay", Json::object()));
  EXPECT_EQ(replayed["state"], "done") << replayed;
  EXPECT_EQ(replayed["text"], "it still fails") << replayed;
  const Answer known = server.post(bucket + "/acknowledge", {{"owner", "ana"}, {"ticket", "12"}});
  EXPECT_EQ(known.status, 200) << known.body;
  EXPECT_EQ(server.get(bucket)["state"], "open");
  EXPECT_EQ(server.post(bucket + "/note", {{"text", "<script>alert(1)</script>"}}).status, 200);
  EXPECT_EQ(server.get(bucket)["note"], "<script>alert(1)</script>");
  EXPECT_EQ(server.post(bucket + "/quarantine", {{"owner", "ana"}, {"reason", "x"}, {"expires", "2029-01-01"}}).status, 422);
  EXPECT_EQ(server.post(bucket + "/quarantine", {{"owner", "ana"}, {"reason", "x"}, {"expires", "2027-03-01"}}).status, 200);
  std::vector<Issue> damaged;
  EXPECT_EQ(Corpus::open(server.folder / "corpus")->buckets(damaged)[0].state, BucketState::quarantined) << "it is on the disk";
}

TEST(Cpu, OfAJobIsTheClientsWhoAskedForIt) {
  Limits limits;
  limits.cpu_s_per_minute = 0.06, limits.cpu_minutes_at_once = 500;
  Server server(limits);
  const std::string replay = "/api/corpus/" + keep(server) + "/replay";
  server.client = "127.0.0.2";
  server.engine->spend(server.client, 30.0 - 0.002);
  const Json job = wait_for(server, server.post(replay, Json::object()));
  EXPECT_GT(job["cpu_s"], 0.0) << job;
  EXPECT_EQ(code_of(server.post(replay, Json::object())), "limit.cpu");
  server.client = "127.0.0.1";
  EXPECT_EQ(server.post(replay, Json::object()).status, 202);
}

TEST(Triage, AReadOnlyServerChangesNothing) {
  Server server({}, true, true);
  const std::string session = open(server, broken());
  for (const std::string& path : {session + "/case", std::string("/api/report"), std::string("/api/corpus/x/shrink"),
                                 std::string("/api/corpus/x/replay")}) {
    const Json body = path.ends_with("/case") ? Json{{"check", "joint_range"}, {"subject", "x"}, {"mode", "kinematic"}} : Json::object();
    const Answer answer = server.post(path, body);
    EXPECT_EQ(answer.status, 403) << path << answer.body;
    EXPECT_EQ(code_of(answer), "guard.read_only");
  }
  EXPECT_EQ(server.post("/api/corpus/x/note", {{"text", "y"}}).status, 403);
  EXPECT_EQ(server.call("GET", "/api/corpus").status, 200);
}

TEST(Triage, BucketsAreFoundAmongTheCorpusBucketsOnly) {
  Server server;
  for (const char* name : {"..", "x", "..%2F..", "joint_range-000000000000"})
    EXPECT_EQ(server.call("GET", std::string("/api/corpus/") + name).status, 404) << name;
}

TEST(Triage, NewsTellWhatHappens) {
  Server server;
  const Answer stream = server.call("GET", "/api/events");
  listen(stream, 1);
  keep(server);
  const auto events = listen(stream, 2);
  EXPECT_TRUE(last(events, "corpus").contains("revision"));
}

// ---- the document

TEST(OpenApi, HasEveryCallWithItsIds) {
  const Json document = Json::parse(openapi("1.2.3"));
  EXPECT_EQ(document["openapi"], "3.1.0");
  std::set<std::string> operations;
  for (const Route& route : routes()) {
    if (!route.documented) continue;
    std::string method(route.method);
    for (char& c : method) c = static_cast<char>(std::tolower(c));
    const Json& call = document["paths"][std::string(route.pattern)][method];
    ASSERT_TRUE(call.is_object()) << route.pattern;
    EXPECT_TRUE(operations.insert(call["operationId"]).second) << call["operationId"];
    EXPECT_EQ(call.contains("requestBody"), route.method == "POST") << route.pattern;
    for (const char* id : {"session", "bucket", "job"})
      if (route.pattern.find("{" + std::string(id) + "}") != std::string_view::npos) {
        EXPECT_EQ(call["parameters"][0]["name"], id);
      }
  }
}

TEST(OpenApi, TheTableInTheDocsIsTheTableOfCalls) {
  const std::string docs = slurp(CONTORT_SOURCE_DIR "/docs/reference/server.md");
  for (const Route& route : routes()) {
    if (!route.documented) continue;
    std::string path(route.pattern.substr(0, route.pattern.rfind('/') + 1));
    const std::string end(route.pattern.substr(route.pattern.rfind('/') + 1));
    EXPECT_NE(docs.find(end.starts_with('{') ? path.substr(0, path.size() - 1) : end), std::string::npos) << route.pattern;
  }
}

}  // namespace
}  // namespace contort::server
