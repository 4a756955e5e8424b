// Runs specs on two builds: a failure counts only if the base does not show it for the same spec
// (docs/reference/against.md).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fuzz/base_build.h"
#include "fuzz/trial.h"

namespace contort {

class AgainstTrial final : public Trial {
 public:
  // `inner` runs this build and looks for the family of `expect`. `alive` is called while waiting for the base.
  AgainstTrial(Trial& inner, const Expectation& expect, BaseBuild& base, const CompareRules& rules,
               std::function<bool()> alive);
  TrialResult run(const Spec& spec, int most_frames) override;
  // Keeps only those of the other families that break or get worse against the base.
  std::vector<Case> others(const Spec& spec) override;

 private:
  Measurement ask(const Spec& spec, const std::string& check) const;

  Trial& inner_;
  std::string check_, subject_;
  bool is_ending_;  // the failure is a crash, a timeout or too much memory: it counts if the base has an answer
  BaseBuild& base_;
  const CompareRules& rules_;
  std::function<bool()> alive_;
};

}  // namespace contort
