// From a stage to findings: the built-in generator makes the motion, and the checks judge it.
#pragma once

#include <string_view>
#include <vector>

#include "checks/judge.h"
#include "generator/generate.h"
#include "generator/stage.h"

namespace contort {

// Owns the memory of one thread's evaluations; nothing of one evaluation reaches the next.
class Evaluator {
 public:
  explicit Evaluator(CheckSettings settings = {}) : judge_(settings) {}

  // Generates and judges. With `only_check`, that check alone.
  Evaluation run(const Stage& stage, std::string_view only_check = {});

  // The motion of the last run, with what belongs to it.
  const Execution& execution() const { return execution_; }
  const Motion& motion() const { return execution_.motion; }

  // Judges a motion that was made elsewhere, see Judge::judge.
  std::vector<Finding> judge(const Character& character, const Motion& motion, std::string_view only_check = {},
                             const Environment& environment = {}, const Intent* intent = nullptr) {
    return judge_.judge(character, motion, only_check, environment, intent);
  }

  const std::vector<SmallestMargins>& smallest_margins() const { return judge_.smallest_margins(); }
  // The curves of the last run, see Judge::curves.
  std::vector<MarginCurve> curves(const Finding& about, std::size_t most) const {
    return judge_.curves(execution_, about, most);
  }

 private:
  Judge judge_;
  GenerateScratch scratch_;
  Execution execution_;
};

}  // namespace contort
