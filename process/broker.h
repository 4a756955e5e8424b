// The server's connection to its worker processes. The server has threads and must not fork. So a process with one
// thread, the broker, is forked before the first thread starts; it owns the workers (process/worker_pool.h) and passes
// tasks to them.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "model/core/result.h"
#include "process/worker_pool.h"

namespace contort {

// The priority of a task: tasks for which a client waits come before those that may be late.
enum class Urgency : std::uint8_t { now, later };

struct BrokerLimits {
  int workers = 2;
  WorkerLimits each;      // limits of one task
  int most_waiting = 64;  // the most tasks that wait for a worker
};

// The outcome of a task, and the time for which a worker had it.
struct BrokerReply {
  Result<std::string> text = Issue{};
  double worker_s = 0.0;
};

struct BrokerLoad {
  int waiting = 0;
  int running = 0;
  std::int64_t done = 0;
  std::int64_t ended_badly = 0;  // tasks that crashed, or exceeded the limit of time or memory
  double worker_s = 0.0;         // time of workers for all tasks
};

class Broker {
 public:
  // `work` runs in the workers. Call it before the process has threads. Throws std::system_error if no process can be
  // started.
  Broker(const BrokerLimits& limits, WorkerPool::Work work);
  ~Broker();  // ends broker and workers
  Broker(const Broker&) = delete;
  Broker& operator=(const Broker&) = delete;

  // Waits for the reply; from any thread. Codes work.busy (too many wait), work.crash, work.timeout, work.memory,
  // work.gone (the broker has ended).
  BrokerReply run(const std::string& task, Urgency urgency);

  BrokerLoad load() const;

 private:
  struct Waiting {
    bool done = false;
    BrokerReply reply;
  };

  void read_replies();
  void finish(std::uint64_t id, BrokerReply reply);

  BrokerLimits limits_;
  int pid_ = -1;
  int socket_ = -1;
  std::mutex sending_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::uint64_t, Waiting*> waiting_;
  std::uint64_t next_id_ = 1;
  bool gone_ = false;
  BrokerLoad load_;
  std::thread reader_;
};

}  // namespace contort
