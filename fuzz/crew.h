// The workers, and the task of each of them: a case of the round, by its place in the round, or a failure to process.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "fuzz/failure_queue.h"
#include "process/worker_pool.h"

namespace contort {

struct PlacedCase {
  int place = 0;
  EvaluateTask task;
};

using Job = std::variant<PlacedCase, FailureJob>;

class Crew {
 public:
  Crew(int workers, const WorkerLimits& limits, WorkerPool::Work work);

  bool has_idle() const { return pool_.idle_worker().has_value(); }
  int busy() const { return pool_.busy(); }
  bool is_any_case_running() const;

  // Gives a job to an idle worker; there must be one.
  void give(const Job& job);

  // Returns a job that a worker has finished, or that ended its worker; empty if no job ends within the time.
  struct Finished {
    Job job;
    WorkerEvent event;
  };
  std::optional<Finished> wait(int milliseconds);

 private:
  WorkerPool pool_;
  std::vector<std::optional<Job>> in_hand_;  // the job of each worker
};

}  // namespace contort
