// Turns a spec into findings: a generator makes the motion, and the checks judge it.
#pragma once

#include <string_view>
#include <vector>

#include "checks/judge.h"
#include "model/generator.h"

namespace contort {

// Evaluates specs, and owns the memory that one thread needs for it. Nothing of one evaluation affects the next.
class Evaluator {
 public:
  // The generator must outlive it, and is used by this thread alone.
  explicit Evaluator(Generator& generator, CheckSettings settings = {})
      : generator_(generator), judge_(std::move(settings)) {}

  Generator& generator() const { return generator_; }

  // Generates and judges. With `only_check`, it runs that check only. If the generator refuses the spec, the issue is
  // the generator's.
  Result<Evaluation> run(const Spec& spec, std::string_view only_check = {});

  // The findings of all checks in the motion of the last run; waived findings are among them.
  std::vector<Finding> judge_by_all_checks() {
    return judge_.judge(*execution_.character, execution_.motion, {}, execution_.environment, execution_.said());
  }

  // The motion of the last run, with what belongs to it.
  const Execution& execution() const { return execution_; }
  const Motion& motion() const { return execution_.motion; }

  const std::vector<SmallestMargins>& smallest_margins() const { return judge_.smallest_margins(); }
  // The curves of the last run, see Judge::curves.
  std::vector<MarginCurve> curves(const Finding& about, std::size_t most) const {
    return judge_.curves(execution_, about, most);
  }

 private:
  Generator& generator_;
  Judge judge_;
  Execution execution_;
};

}  // namespace contort
