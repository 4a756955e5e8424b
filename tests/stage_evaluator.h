// Evaluates stages, which tests build and change by hand, and specs by the built-in generator over the stock library.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "checks/judge.h"
#include "generator/built_in.h"
#include "generator/execute.h"

namespace contort {

class StageEvaluator {
 public:
  explicit StageEvaluator(CheckSettings settings = {}) : judge_(std::move(settings)) {}

  Evaluation run(const Stage& stage, std::string_view only_check = {}) {
    execute(stage, scratch_, execution_);
    return judge_.evaluate(execution_, only_check);
  }
  std::vector<Finding> judge(const Character& character, const Motion& motion, std::string_view only_check = {},
                             const Environment& environment = {}, const Intent* intent = nullptr) {
    return judge_.judge(character, motion, only_check, environment, intent);
  }
  const Execution& execution() const { return execution_; }
  const Motion& motion() const { return execution_.motion; }
  const std::vector<SmallestMargins>& smallest_margins() const { return judge_.smallest_margins(); }
  std::vector<MarginCurve> curves(const Finding& about, std::size_t most) const {
    return judge_.curves(execution_, about, most);
  }

 private:
  Judge judge_;
  GenerateScratch scratch_;
  Execution execution_;
};

// The findings of a stage, one in each line.
inline std::string broken_in(const Stage& stage) {
  StageEvaluator evaluator;
  std::string all;
  for (const Finding& finding : evaluator.run(stage).findings) all += finding.check + " " + finding.subject + "\n";
  return all;
}

// Each thread has its own.
inline Generator& stock_generator() {
  thread_local BuiltInGenerator generator;
  return generator;
}

}  // namespace contort
