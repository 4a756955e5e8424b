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

  // A case that has its report, in the order of cases. Gives the failures to be settled: of the first cases of each
  // family those that are among the earliest of their case.
  std::vector<SettleTask> add(const RoundCase& one);

  // "guided", "seed"
  std::string strategy_of_case(const Lineage& lineage) const;

 private:
  void learn(const Lineage& lineage, const EvaluateReport& report);
  void count(const EvaluateReport& report, bool fails, const std::string& strategy_name);
  bool wants(const Family& family, std::size_t rank, std::int64_t index, const std::string& strategy_name);

  const RunConfig& config_;
  RunState& state_;
};

}  // namespace contort
