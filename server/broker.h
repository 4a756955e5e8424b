// The way to the worker processes. The front has threads and must not fork, so a process with one thread, the broker, is
// split off before the first of them; it keeps the workers (fuzz/worker_pool.h) and hands tasks on.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "fuzz/worker_pool.h"
#include "generator/core/result.h"

namespace contort::server {

// What a terminal waits for goes before what it can do without for a moment.
enum class Urgency : std::uint8_t { now, later };

struct BrokerLimits {
  int workers = 2;
  WorkerLimits each;      // of one task
  int most_waiting = 64;  // tasks without a worker
};

struct BrokerLoad {
  int waiting = 0;
  int running = 0;
  std::int64_t done = 0;
  std::int64_t ended_badly = 0;  // crashed, over the time, over the memory
  double busy_s = 0.0;           // time in workers, as the front saw it
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
  Result<std::string> run(const std::string& task, Urgency urgency);

  BrokerLoad load() const;

 private:
  struct Waiting {
    bool done = false;
    Result<std::string> result = Issue{};
  };

  void read_replies();
  void finish(std::uint64_t id, Result<std::string> result);

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

}  // namespace contort::server
