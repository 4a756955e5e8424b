// The way to the worker processes. The front has threads and must not fork, so a process with one thread, the broker,
// is split off before the first of them; it keeps the workers (process/worker_pool.h) and hands tasks on.
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

// Tasks that a terminal waits for go before those that it can do without for a moment.
enum class Urgency : std::uint8_t { now, later };

struct BrokerLimits {
  int workers = 2;
  WorkerLimits each;      // of one task
  int most_waiting = 64;  // tasks without a worker
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
  std::int64_t ended_badly = 0;  // crashed, over the time, over the memory
  double worker_s = 0.0;         // of all tasks
};

class Broker {
 public:
  // `work` runs in the workers. To be called before the process has threads. Throws std::system_error where the system
  // gives no more processes.
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
