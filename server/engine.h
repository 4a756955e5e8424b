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
  int sessions = 256;  // sessions of all clients
  int sessions_of_client = 16;
  int streams = 64;  // streams of all clients
  int streams_of_client = 16;
  double calls_per_s = 30.0;       // calls of one client, on average
  double calls_at_once = 120.0;    // calls of one client after a pause
  double cpu_s_per_minute = 60.0;  // CPU time of one client's motions and jobs, on average
  double cpu_minutes_at_once = 5;  // the same after a pause
  int spec_bytes = 256 << 10;      // size of a call's body
  int library_bytes = 1 << 20;
  double take_s = 10.0;        // length of a take; each command generates the whole take again
  double most_s = 60.0;        // greatest length of a take with more in its queue
  int frame_bytes = 64 << 20;  // frames of one motion
  double idle_s = 600.0;       // a session that is unused for so long ends
  int jobs = 16;               // the most jobs that wait
};

// The result of a task, with the worker's CPU time; if the task ended abnormally, its whole time in the worker.
struct Worked {
  Result<Reply> reply;
  double cpu_s = 0.0;
};

class Engine {
 public:
  // Construct it before the process has threads. The generator must outlive it.
  Engine(const Limits& limits, const BrokerLimits& workers, Generator& generator, const CheckSettings& settings,
         const std::string& tool);
  ~Engine();

  // Runs a task. Its CPU time is charged to the client. Codes of Broker::run and Worker::run; limit.cpu for urgent
  // tasks of a client without CPU time left. Other tasks continue work that was begun, and always run.
  Worked run(const Task& task, const std::string& client, Urgency urgency = Urgency::now);

  // Checks that the client may start work outside of the workers. Code limit.cpu.
  Result<Done> may_work(const std::string& client);
  void spend(const std::string& client, double cpu_s);
  double wait_s(const std::string& client);  // seconds until the client has CPU time again

  // Calls `work` soon, in another thread. Only one call of each key waits at a time.
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
