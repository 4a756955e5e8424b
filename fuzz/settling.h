// The failures of a run, from first sight to bucket: what is to be run again and shrunk, in which order, and what to do
// with the answer of the worker that did it.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "fuzz/case_work.h"
#include "fuzz/run.h"
#include "fuzz/run_state.h"

namespace contort {

class Settling {
 public:
  // `state` is the run's; what is wanted and what was filed is written there.
  Settling(const RunConfig& config, Generator& generator, const Corpus& corpus, RunState& state)
      : config_(config), generator_(generator), corpus_(corpus), state_(state) {}

  // With what the state of an interrupted run wants.
  void go_on();

  // With what runs before left in this corpus, since their time was up before it was shrunk.
  void find_waiting();

  void want(const CaseTask& task);

  // Time is up: what is left is only kept, and another run on this corpus shrinks it.
  void only_keep();

  // What a worker shall do next. `with_waiting`: there is time for what runs before left.
  std::optional<CaseTask> next(bool with_waiting);
  bool is_done(bool with_waiting) const { return wanted_.empty() && (!with_waiting || waiting_.empty()); }

  // What became of a task that next() gave.
  void take(const CaseTask& task, const WorkerEvent& event);

  // It ended its process and, tried again, did not.
  void keep_ending_of_once(const Case& ended, const CaseTask& task);

  // Paths of leads that time did not reach.
  std::vector<std::string> waiting() const;
  int waiting_count() const { return static_cast<int>(state_.wanted.size() + waiting_.size()); }

  // The first trouble with the corpus; code "" where all went well.
  const Issue& issue() const { return issue_; }

 private:
  void settled(const CaseTask& task, const WorkerEvent& event);
  void shrunk_waiting(CaseTask task, const WorkerEvent& event);
  void settle_no_more(const CaseTask& of_case, const std::vector<std::string>& families);
  void shrink_guarded(CaseTask task, const WorkerEvent& event);
  void take_met(const std::string& run, const CaseTask& task, const CaseReport& report);
  void take_lead(const std::string& path, bool confirmed);
  void file(const std::string& path);
  void keep(const Lead& lead);
  void keep_unsteady(const Case& seen, const CaseTask& task);
  std::string path_of_lead(const CaseTask& task) const;
  std::string path_of_met(const std::string& run, const CaseTask& task, const std::string& family) const;
  void fail(const Issue& issue);

  const RunConfig& config_;
  Generator& generator_;
  const Corpus& corpus_;
  RunState& state_;
  std::deque<CaseTask> wanted_;    // those of the state that no worker has in hand
  std::deque<CaseTask> waiting_;   // leads of runs whose time was up
  std::vector<CaseTask> in_hand_;  // of workers
  std::vector<std::string> kept_;  // leads of this run that wait for another
  Issue issue_;
};

// "crash|human|SIGSEGV": what became of the process that ran a spec: the one it noted, or `given` where it came to
// none.
Case case_of_ending(const WorkerEvent& event, const Spec& given, const WorkerLimits& limits);

}  // namespace contort
