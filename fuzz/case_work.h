// What a worker does with a case, and the messages that go there and back. Both are JSON, so that they can be read in a
// debugger and are checked on arrival.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "checks/check.h"
#include "corpus/leads.h"
#include "process/worker_pool.h"
#include "fuzz/islands.h"
#include "fuzz/run.h"

namespace contort {

// Evaluate a case; or, with a family, settle that failure of it: run it again, keep it as a lead, shrink it. Or, with a
// lead, shrink what waits there since the time of some run was up.
struct CaseTask {
  Lineage lineage;
  std::string family;
  int rank = 0;             // of the family among those of the case, by first frame
  std::string motion_hash;  // of the first time
  std::string ending;       // family of how it ended its process before, or a candidate of its shrinking did
  bool shrinks = true;      // false: there is no time; the lead waits
  std::string lead;         // path of its original
  bool operator==(const CaseTask&) const = default;
};

struct CaseReport {
  bool built = false;
  int frames = 0;
  std::string motion_hash;
  std::vector<std::string> tested;  // labels of what the case was made of
  std::vector<std::string> broken;  // families, by their first frame, then the deepest in its check's scale
  std::vector<NearMiss> near;       // of the subjects of the island's group
  std::vector<WaiverUse> waivers;
  bool confirmed = false;             // of a settled failure: the second time was bit for bit the first
  std::vector<std::string> also;      // families of the case that its minimal spec shows too, and who names it
  std::vector<std::string> met;       // families of other leads that its shrinking left
  std::vector<std::string> met_once;  // the same, which did not happen again
  std::string issue;                  // it could not be written: code and text
};

std::string print_task(const CaseTask& task);
CaseTask parse_task(const std::string& text);
CaseReport parse_report(const std::string& text);

// What is known of a failure that did not show again. How deep it was, nobody wrote down: no number.
Case seen_once(const CaseTask& task, const Spec& spec, Generator& generator, const WorkerLimits& limits);

// Which group each subject falls to (islands.h). Remembered, by all that names it: naming and hashing them for each
// case was 1 % of a run.
class TargetGroups {
 public:
  const std::vector<std::int8_t>& of(const CheckDef& check, const Character& character, std::size_t subjects);

 private:
  std::map<std::tuple<std::string_view, std::string, std::uint64_t>, std::vector<std::int8_t>> known_;
};

// One per worker.
class CaseWork {
 public:
  CaseWork(const RunConfig& config, Generator& generator, const Corpus& corpus);
  std::string operator()(const std::string& task, WorkerSlot& slot);

 private:
  CaseReport evaluate(const CaseTask& task, WorkerSlot& slot);
  std::vector<NearMiss> near_misses(const Character& character, int group);
  CaseReport settle(const CaseTask& task, WorkerSlot& slot);
  CaseReport shrink_waiting(const CaseTask& task, WorkerSlot& slot);
  std::optional<Case> shown_again(const CaseTask& task, const Spec& spec);
  Shrunk shrink_one(const Case& original, const std::string& run, bool guarded, WorkerSlot& slot,
                    const Onward& onward) const;
  Result<std::string> shrink_lead(const CaseTask& task, Lead& lead, CaseReport& report, WorkerSlot& slot) const;
  std::function<bool(const Spec&)> allowed_for(const Case& original, const std::string& run) const;
  Result<std::string> keep_met(const Lead& shrunk, const Case& met, CaseReport& report, WorkerSlot& slot) const;

  const RunConfig& config_;
  Generator& generator_;
  const Corpus& corpus_;
  Evaluator evaluator_;
  TargetGroups groups_;
};

}  // namespace contort
