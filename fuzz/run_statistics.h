// Counts the cases of a run, learns from them, and decides which of their failures are to be settled.
#pragma once

#include <string>
#include <vector>

#include "fuzz/messages.h"
#include "fuzz/round.h"
#include "fuzz/run.h"
#include "fuzz/run_state.h"

namespace contort {

class RunStatistics {
 public:
  // Both must live as long as this.
  RunStatistics(const RunConfig& config, RunState& state) : config_(config), state_(state) {}

  // Adds the report of a case; cases must come in order. Returns the failures to be processed: those of the first cases
  // of each family that are among the earliest of their case.
  std::vector<SettleTask> add(const RoundCase& one);

  // Returns the way in which a case was made: "guided", "seed".
  std::string strategy_of_case(const Lineage& lineage) const;

 private:
  void learn(const Lineage& lineage, const EvaluateReport& report);
  void count(const EvaluateReport& report, std::int64_t index, bool fails, const std::string& strategy_name);
  void count_group(std::int64_t index, const std::vector<Family>& counted);
  bool wants(const Family& family, std::size_t rank, std::int64_t index, const std::string& strategy_name);

  const RunConfig& config_;
  RunState& state_;
};

}  // namespace contort
