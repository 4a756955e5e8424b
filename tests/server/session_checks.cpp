// Sessions that several threads use at the same time.
#include <atomic>
#include <thread>

#include "tests/server/app_fixture.h"

namespace contort::server {
namespace {

// Calls `session` from several threads until it is destroyed; counts answers without a motion.
class Readers {
 public:
  Readers(const Server& server, const std::string& session) {
    for (const std::string path : {"", "", "/frames?mode=kinematic&from=0&count=1"})
      threads_.emplace_back([this, &server, path = session + path] {
        while (!ends_) bad_ += server.call("GET", path).status != 200;
      });
    threads_.emplace_back([this, &server, path = session + "/stream"] {
      const Answer stream = server.call("GET", path);
      for (bool more = true; more && !ends_;) stream.pieces(more);
    });
  }
  ~Readers() { stop(); }
  int stop() {
    ends_ = true;
    for (std::thread& thread : threads_)
      if (thread.joinable()) thread.join();
    return bad_;
  }

 private:
  std::atomic<bool> ends_ = false;
  std::atomic<int> bad_ = 0;
  std::vector<std::thread> threads_;
};

Limits limits_for_many_calls() {
  Limits limits;
  limits.take_s = 0.1, limits.calls_per_s = 1e6, limits.calls_at_once = 1000000000, limits.cpu_s_per_minute = 1e6;
  return limits;
}

TEST(Session, IsNeverWithoutAMotionWhileATakeFollowsAnother) {
  Server server(limits_for_many_calls());
  const std::string session =
      "/api/sessions/" +
      Json::parse(server.post("/api/sessions", {{"spec", standing()}}).body).at("session").get<std::string>();
  Readers readers(server, session);
  for (int i = 0; i < 40; ++i) {
    const char* arm = i % 2 == 0 ? "mech_arm_shield" : "mech_arm_extend";
    const Answer changed =
        server.post(session + "/change", {{"character", {{"name", "mech"}, {"parts", {{"arm_right", arm}}}}}});
    ASSERT_EQ(changed.status, 200) << changed.body;
  }
  EXPECT_EQ(readers.stop(), 0);
}

TEST(Stream, ThatCannotBeMadeEndsAlone) {
  Server server;
  const Answer stream =
      server.app->stream(server.client, [](bool&) -> std::vector<Event> { throw std::out_of_range("a fault"); });
  bool more = true;
  EXPECT_EQ(stream.pieces(more), "");
  EXPECT_FALSE(more);
  EXPECT_NE(server.app->metrics().find("contort_calls_failed_total 1"), std::string::npos) << server.app->metrics();
}

}  // namespace
}  // namespace contort::server
