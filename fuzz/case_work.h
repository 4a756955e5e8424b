// Does the tasks of messages.h in a worker.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "checks/check.h"
#include "fuzz/against_work.h"
#include "fuzz/messages.h"
#include "fuzz/run.h"
#include "process/worker_pool.h"

namespace contort {

// The case of a failure that did not show again. Its depth is unknown, so the margin is NaN.
Case seen_once(const SettleTask& task, const Spec& spec, Generator& generator, const WorkerLimits& limits);

// The group of each subject (islands.h). Results are cached, because naming and hashing subjects for each case took 1 %
// of a run.
class TargetGroups {
 public:
  const std::vector<std::int8_t>& of(const CheckDef& check, const Character& character, std::size_t subjects);

 private:
  std::map<std::tuple<std::string_view, std::string, std::uint64_t>, std::vector<std::int8_t>> known_;
};

// The tasks of one worker.
class CaseWork {
 public:
  CaseWork(const RunConfig& config, Generator& generator, const Corpus& corpus);
  std::string operator()(const std::string& task, WorkerSlot& slot);

 private:
  EvaluateReport evaluate(const EvaluateTask& task, WorkerSlot& slot);
  EvaluateReport report_of(const EvaluateTask& task, const Spec& spec, const Evaluation& evaluation);
  bool counts_again(Case& found, const std::string& base_hash, WorkerSlot& slot);
  SettleReport settle(const SettleTask& task, WorkerSlot& slot);
  ShrinkReport shrink_waiting(const ShrinkTask& task, WorkerSlot& slot);
  std::vector<NearMiss> near_misses(const Character& character, int group);
  std::optional<Case> shown_again(const SettleTask& task, const Spec& spec);
  Shrunk shrink_one(const Case& original, const std::string& run, bool guarded, WorkerSlot& slot,
                    const PrimarySearch& search);
  Result<Done> shrink_lead(SettledLead& settled, bool guarded, WorkerSlot& slot);
  bool take_shrunk(Shrunk& shrunk, Lead& lead, bool guarded, WorkerSlot& slot);
  std::function<bool(const Spec&)> allowed_for(const Case& original, const std::string& run) const;
  Result<Done> keep_incidental(const Case& met, SettledLead& settled, WorkerSlot& slot);

  const RunConfig& config_;
  Generator& generator_;
  const Corpus& corpus_;
  Evaluator evaluator_;
  TargetGroups groups_;
  std::optional<AgainstWork> against_;
};

}  // namespace contort
