// The queue of a run's failures on their way to buckets. It decides which ones are run again and shrunk, and in which
// order, and it processes the workers' answers.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "corpus/corpus.h"
#include "fuzz/messages.h"
#include "fuzz/run.h"
#include "fuzz/run_state.h"

namespace contort {

// A failure of this run that is not in a bucket yet.
struct WantedFailure {
  SettleTask task;
  std::optional<Lead> ender{};  // the candidate that ended the first worker: stored, but not confirmed yet
};

// A lead of a run whose time was up.
struct WaitingLead {
  ShrinkTask task;
  std::string run;
  std::int64_t index = 0;  // index of its case
};

using FailureJob = std::variant<WantedFailure, WaitingLead>;

Task task_of(const FailureJob& job);

class FailureQueue {
 public:
  // `state` is the run's; wanted failures and filed buckets are written to it.
  FailureQueue(const RunConfig& config, Generator& generator, const Corpus& corpus, RunState& state)
      : config_(config), generator_(generator), corpus_(corpus), state_(state) {}

  // Adds the failures that the state of an interrupted run has.
  void go_on();

  // Adds the failures that earlier runs left in this corpus when their time was up.
  void find_waiting();

  void want(const SettleTask& task);

  // Time is up: the remaining failures are only stored, and another run on this corpus shrinks them.
  void only_keep();

  // The next task for a worker. `with_waiting`: there is time for the failures of earlier runs.
  std::optional<FailureJob> next(bool with_waiting);
  bool is_done(bool with_waiting) const { return wanted_.empty() && (!with_waiting || waiting_.empty()); }

  // Records the outcome of a job that next() gave.
  void take(const FailureJob& job, const WorkerEvent& event);

  // Records a case that crashed once, and not when it was run again.
  void keep_ending_of_once(const Case& ended, const Lineage& lineage);

  // Paths of leads that were not shrunk in time.
  std::vector<std::string> waiting() const;
  int waiting_count() const { return static_cast<int>(state_.wanted.size() + waiting_.size()); }

  // The first error of the corpus; code "" if there was none.
  const Issue& issue() const { return issue_; }

 private:
  using CaseId = std::pair<std::string, std::int64_t>;  // run and index
  CaseId case_of(const FailureJob& job) const;

  void take_wanted(const WantedFailure& job, const WorkerEvent& event);
  void take_waiting(WaitingLead job, const WorkerEvent& event);
  void take_settled(const SettledLead& settled);
  void settle_no_more(const SettleTask& of_case, const std::set<Family>& families);
  void shrink_guarded(WantedFailure job, const WorkerEvent& event);
  void file(const Lead& lead);
  void keep(const Lead& lead);
  void keep_unsteady(Lead lead);
  Lead lead_of(const Case& seen, const Lineage& lineage, int rank) const;
  void fail(const Issue& issue);

  const RunConfig& config_;
  Generator& generator_;
  const Corpus& corpus_;
  RunState& state_;
  std::deque<WantedFailure> wanted_;  // failures of the state on which no worker works
  std::deque<WaitingLead> waiting_;
  std::vector<CaseId> in_hand_;    // failures on which workers work
  std::vector<std::string> kept_;  // leads of this run that wait for another run
  Issue issue_;
};

// "crash|human|SIGSEGV": the failure of the process that ran a spec. It is about the spec that the process noted, or
// about `given` if it noted none.
Case case_of_ending(const WorkerEvent& event, const Spec& given, const WorkerLimits& limits);

}  // namespace contort
