// Runs work in worker processes. Work that crashes, hangs or uses too much memory ends only its process; the pool
// reports the ending and the last note of the work, and starts another worker. The caller must have no other threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "process/isolate.h"

namespace contort {

// Memory that a worker shares with its pool. It outlives the worker.
class WorkerSlot {
 public:
  static constexpr std::size_t kMostNote = 1 << 20;

  // Notes the present work, before it begins. A note that is too long is replaced by an empty one.
  void note(std::string_view text);
  // Restarts the time limit.
  void beat() { beats_.fetch_add(1, std::memory_order_relaxed); }

  std::string note() const { return std::string(text_, length_); }

  // Notes how a program ended on which the work depended, before the worker ends (ended.h).
  void end(std::string_view ending);
  std::string ended() const { return std::string(ending_, ending_length_); }
  std::uint64_t beats() const { return beats_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> beats_{0};
  std::size_t length_ = 0;
  char text_[kMostNote] = {};
  std::size_t ending_length_ = 0;
  char ending_[kMostPrinted + 100] = {};
};

struct WorkerLimits {
  double seconds = 10.0;                       // longest time between two beats
  std::int64_t bytes = std::int64_t{4} << 30;  // resident memory
};

enum class WorkerEnd { replied, crashed, timed_out, out_of_memory };

struct WorkerEvent {
  int worker = 0;
  WorkerEnd end = WorkerEnd::replied;
  std::string text;  // the reply; for a crash the signal, "SIGSEGV", or "exit 3"
  std::string note;  // if it did not reply: the last note of its work
  std::string printed{};  // last output of a program that ended and made the worker end
};

// The outcome must not be a reply.
Ending ending_of(const WorkerEvent& event);

// The same limits for one process.
Isolation isolation_of(const WorkerLimits& limits);

class WorkerPool {
 public:
  using Work = std::function<std::string(const std::string& task, WorkerSlot& slot)>;

  // Throws std::system_error if no process can be started.
  WorkerPool(int workers, const WorkerLimits& limits, Work work);
  ~WorkerPool();  // kills workers that still run
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  std::optional<int> idle_worker() const;
  int busy() const;
  // The time limit is multiplied by `patience`.
  void give(int worker, const std::string& task, double patience = 1.0);

  // Returns the next worker that replied or ended, or nothing if none does within the time. Returns at once if there is
  // something to read on `other`, a socket of the caller.
  std::optional<WorkerEvent> wait(int milliseconds, int other = -1);

 private:
  struct Worker {
    int pid = -1;
    int socket = -1;
    WorkerSlot* slot = nullptr;
    bool busy = false;
    std::string received;
    std::uint64_t beats = 0;
    double since_s = 0.0;  // time of the last beat
    double patience = 1.0;
  };

  void start(Worker& worker);
  [[noreturn]] void serve(int socket, WorkerSlot& slot) noexcept;
  std::optional<WorkerEvent> receive(int index);
  std::optional<WorkerEvent> over_limit(int index);
  WorkerEvent bury(int index, WorkerEnd end);

  WorkerLimits limits_;
  Work work_;
  std::vector<Worker> workers_;
  double looked_s_ = 0.0;
};

}  // namespace contort
