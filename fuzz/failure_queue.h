// The failures of a run, from first sight to bucket: what is to be run again and shrunk, in which order, and what to do
// with the answer of the worker that did it.
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

// A failure of this run, on its way.
struct WantedFailure {
  SettleTask task;
  std::optional<Lead> ender{};  // what ended the worker that shrank it first: kept, and not confirmed yet
};

// A lead of a run whose time was up.
struct WaitingLead {
  ShrinkTask task;
  std::string run;
  std::int64_t index = 0;  // of its case
};

using FailureJob = std::variant<WantedFailure, WaitingLead>;

Task task_of(const FailureJob& job);

class FailureQueue {
 public:
  // `state` is the run's; what is wanted and what was filed is written there.
  FailureQueue(const RunConfig& config, Generator& generator, const Corpus& corpus, RunState& state)
      : config_(config), generator_(generator), corpus_(corpus), state_(state) {}

  // With what the state of an interrupted run wants.
  void go_on();

  // With what runs before left in this corpus, since their time was up before it was shrunk.
  void find_waiting();

  void want(const SettleTask& task);

  // Time is up: what is left is only kept, and another run on this corpus shrinks it.
  void only_keep();

  // The next task for a worker. `with_waiting`: there is time for what earlier runs left.
  std::optional<FailureJob> next(bool with_waiting);
  bool is_done(bool with_waiting) const { return wanted_.empty() && (!with_waiting || waiting_.empty()); }

  // Records the outcome of a job that next() gave.
  void take(const FailureJob& job, const WorkerEvent& event);

  // It ended its process and, tried again, did not.
  void keep_ending_of_once(const Case& ended, const Lineage& lineage);

  // Paths of leads that time did not reach.
  std::vector<std::string> waiting() const;
  int waiting_count() const { return static_cast<int>(state_.wanted.size() + waiting_.size()); }

  // The first trouble with the corpus; code "" where all went well.
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
  std::deque<WantedFailure> wanted_;  // those of the state that no worker has in hand
  std::deque<WaitingLead> waiting_;
  std::vector<CaseId> in_hand_;    // of workers
  std::vector<std::string> kept_;  // leads of this run that wait for another
  Issue issue_;
};

// "crash|human|SIGSEGV": what became of the process that ran a spec: the one it noted, or `given` where it came to
// none.
Case case_of_ending(const WorkerEvent& event, const Spec& given, const WorkerLimits& limits);

}  // namespace contort
