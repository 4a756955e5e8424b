// Measures the delay until a client sees the effect of its command: eight clients play mech in dynamic mode at 30
// frames a second, and each sends a command from time to time. It needs a running server:
//
// contort_serve_bench PORT [SECONDS] [TERMINALS]
#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

double ms_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double, std::milli>(b - a).count(); }

struct Terminal {
  std::string session;
  std::mutex mutex;
  Clock::time_point asked{};       // time of the latest command; none if it was answered
  bool waits = false;
  std::vector<double> latencies_ms;
  double worst_late_ms = -1e9;     // greatest delay of a frame after the time at which it is shown
  int frames = 0;
  int late = 0;                    // frames that were late by more than 100 ms
};

constexpr double kRate_hz = 30.0;

// Reads the stream like a page: it has the clock and the frames that arrived.
class Listener {
 public:
  explicit Listener(Terminal& terminal) : terminal_(terminal) {}

  void take(const char* data, std::size_t size) {
    text_.append(data, size);
    for (std::size_t end; (end = text_.find("\n\n")) != std::string::npos; text_.erase(0, end + 2)) handle(text_.substr(0, end));
  }

 private:
  void handle(const std::string& event) {
    const Clock::time_point now = Clock::now();
    const std::size_t line = event.find("\ndata: ");
    if (!event.starts_with("event: ") || line == std::string::npos) return;
    const std::string name = event.substr(7, line - 7);
    if (name != "clock" && name != "frames") return;
    const Json data = Json::parse(event.substr(line + 7));
    if (name == "clock") {
      shown_at_ = now - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(data["frame"].get<double>() / kRate_hz));
      plays_ = data["playing"];
      return;
    }
    const int from = data["from"], count = data["count"];
    terminal_.frames += count;
    const std::lock_guard lock(terminal_.mutex);
    const bool is_answer = data["revision"].get<int>() > revision_;
    if (terminal_.waits && is_answer) {
      terminal_.latencies_ms.push_back(ms_between(terminal_.asked, now));
      terminal_.waits = false;
    }
    // Frames of a running motion must arrive before they are shown. After a command, frames that were already shown
    // come again.
    if (!is_answer && plays_ && data["take"] == take_)
      for (int f = from; f < from + count; ++f) {
        const double late = ms_between(shown_at_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(f / kRate_hz)), now);
        if (f < reached_) continue;
        terminal_.worst_late_ms = std::max(terminal_.worst_late_ms, late);
        if (late > 100.0) ++terminal_.late;
      }
    reached_ = data["take"] == take_ ? std::max(reached_, from + count) : from + count;
    take_ = data["take"], revision_ = data["revision"];
  }

  Terminal& terminal_;
  std::string text_;
  Clock::time_point shown_at_{};
  bool plays_ = false;
  int take_ = 0, revision_ = 0, reached_ = 0;
};

httplib::Result post(httplib::Client& client, const std::string& path, const Json& body) {
  return client.Post(path, body.dump(), "application/json");
}

Json command(std::mt19937& random, std::string& path) {
  if (random() % 2 == 0) {
    path = "/push";
    return {{"slot", "torso"}, {"impulse_N_s", {static_cast<int>(random() % 60) - 30, 0, static_cast<int>(random() % 60) - 30}}};
  }
  path = "/aim";
  return {{"slot", "head"}, {"action", "look_at"}, {"target_m", {static_cast<int>(random() % 7) - 3, 1.5, 4}}, {"duration_frames", 30}};
}

double at(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

}  // namespace

int main(int argc, char** argv) {
  const int port = argc > 1 ? std::atoi(argv[1]) : 8080, seconds = argc > 2 ? std::atoi(argv[2]) : 60;
  const int count = argc > 3 ? std::atoi(argv[3]) : 8;
  std::vector<std::unique_ptr<Terminal>> terminals;
  httplib::Client client("127.0.0.1", port);
  const Json spec = {{"format", "contort.spec/1"}, {"character", {{"name", "mech"}}}, {"rate_hz", kRate_hz}, {"dynamics", {{"mode", "dynamic"}}}};
  for (int i = 0; i < count; ++i) {
    terminals.push_back(std::make_unique<Terminal>());
    const auto opened = post(client, "/api/sessions", {{"spec", spec}});
    if (!opened || opened->status != 201) return std::fprintf(stderr, "no session: %s\n", opened ? opened->body.c_str() : "no server"), 1;
    terminals.back()->session = "/api/sessions/" + Json::parse(opened->body)["session"].get<std::string>();
  }
  std::atomic<bool> over = false;
  std::vector<std::thread> threads;
  for (auto& terminal : terminals) {
    threads.emplace_back([&, t = terminal.get()] {
      httplib::Client stream("127.0.0.1", port);
      Listener listener(*t);
      stream.Get(t->session + "/stream", [&](const char* data, std::size_t size) { return listener.take(data, size), !over.load(); });
    });
    threads.emplace_back([&, t = terminal.get(), seed = threads.size()] {
      std::mt19937 random(static_cast<unsigned>(seed));
      httplib::Client calls("127.0.0.1", port);
      post(calls, t->session + "/clock", {{"play", true}});
      while (!over) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1500 + random() % 2000));
        std::string path;
        const Json body = command(random, path);
        {
          const std::lock_guard lock(t->mutex);
          t->asked = Clock::now(), t->waits = true;
        }
        const auto answer = post(calls, t->session + path, body);
        if (answer && answer->status == 409) post(calls, t->session + "/change", Json::object());
      }
    });
  }
  std::this_thread::sleep_for(std::chrono::seconds(seconds));
  over = true;
  std::vector<double> all;
  double late_ms = -1e9;
  int late = 0, frames = 0;
  for (const auto& terminal : terminals) {
    const auto state = client.Get(terminal->session);
    std::printf("terminal: %zu commands, median %.1f ms, frames %d, latest frame %.1f ms %s, CPU %.2f s\n", terminal->latencies_ms.size(),
                at(terminal->latencies_ms, 0.5), terminal->frames, std::abs(terminal->worst_late_ms),
                terminal->worst_late_ms < 0 ? "before its time" : "late", state ? Json::parse(state->body).value("cpu_s", 0.0) : 0.0);
    all.insert(all.end(), terminal->latencies_ms.begin(), terminal->latencies_ms.end());
    late_ms = std::max(late_ms, terminal->worst_late_ms), late += terminal->late, frames += terminal->frames;
  }
  std::printf("%d terminals, %d s: %zu commands, first frame after %.1f ms (median), %.1f (p99), %.1f (most); %d frames, latest %.1f ms, "
              "%d later than 100 ms\n", count, seconds, all.size(), at(all, 0.5), at(all, 0.99), at(all, 1.0), frames, late_ms, late);
  for (const auto& terminal : terminals) client.Delete(terminal->session);
  for (std::thread& thread : threads) thread.join();
  return 0;
}
