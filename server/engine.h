// The engine that sessions and calls share: workers, limits, and the thread that judges.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "server/allowance.h"
#include "process/broker.h"
#include "server/work.h"

namespace contort::server {

struct Limits {
  int sessions = 256;  // in total
  int sessions_of_client = 16;
  int streams = 64;  // in total
  int streams_of_client = 16;
  double calls_per_s = 30.0;       // of one client, on average
  double calls_at_once = 120.0;    // after a pause
  double cpu_s_per_minute = 60.0;  // of one client's motions and jobs, on average
  double cpu_minutes_at_once = 5;  // of these, after a pause
  int spec_bytes = 256 << 10;      // of a call's body
  int library_bytes = 1 << 20;
  double take_s = 10.0;        // length of a take: each command generates all of it again
  double most_s = 60.0;        // its greatest length, if more is queued
  int frame_bytes = 64 << 20;  // of one motion
  double idle_s = 600.0;       // after which a session that nobody uses ends
  int jobs = 16;               // the most jobs that wait
};

// The result of a task, with the worker's CPU time; if the task ended abnormally, its whole time in the worker.
struct Worked {
  Result<Reply> reply;
  double cpu_s = 0.0;
};

class Engine {
 public:
  // Before the process has threads. The generator must outlive it.
  Engine(const Limits& limits, const BrokerLimits& workers, Generator& generator, const CheckSettings& settings,
         const std::string& tool);
  ~Engine();

  // The time that it takes is on the client's account. Codes of Broker::run and Worker::run; limit.cpu for urgent tasks
  // of a client without CPU time left; other tasks continue work that was begun, and run.
  Worked run(const Task& task, const std::string& client, Urgency urgency = Urgency::now);

  // For work outside of the workers. Code limit.cpu.
  Result<Done> may_work(const std::string& client);
  void spend(const std::string& client, double cpu_s);
  double wait_s(const std::string& client);  // seconds until something is left

  // Calls `work` soon, in another thread; equal keys that still wait are one.
  void later(const std::string& key, std::function<void()> work);

  const Limits& limits() const { return limits_; }
  BrokerLoad load() const { return broker_.load(); }

 private:
  void do_later();

  Limits limits_;
  Allowance cpu_left_;
  Broker broker_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<std::string, std::function<void()>>> waiting_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace contort::server
