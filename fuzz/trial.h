// Runs specs to see what they show of the family that is being shrunk.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "corpus/case.h"
#include "corpus/evaluator.h"
#include "fuzz/comparison.h"
#include "process/isolate.h"
#include "model/generator.h"

namespace contort {

struct TrialResult {
  bool built = false;  // a spec that is refused costs nothing
  bool fails = false;
  int most_frames = 0;  // that the motion can have
  double depth = 0.0;   // infinite where the margin is no number
  Expectation expect;
  std::shared_ptr<const Character> character;  // null where the generator runs in another process
  std::vector<ActionSpan> spans;               // what moved, and when
  std::vector<Case> met;                       // failures of other families that were seen at no further cost
  BaseShows base = BaseShows::passes_check;    // of a failure that counts against a base
  std::string base_hash{};                     // of the base's motion
};

// Told each spec in the process that runs it, before it does: what it notes may be its last words.
using BeforeRun = std::function<void(const Spec&)>;

class Trial {
 public:
  virtual ~Trial() = default;
  // A motion of more than `most_frames` is refused before it is generated.
  virtual TrialResult run(const Spec& spec, int most_frames) = 0;
  // Failures of all other families in the motion of the spec that was run last, the deepest of each.
  virtual std::vector<Case> others(const Spec& spec) = 0;
};

// For a failure that a check found: that check alone is measured.
class CheckTrial final : public Trial {
 public:
  CheckTrial(const Expectation& family, Generator& generator, const CheckSettings& settings, BeforeRun before = {});
  TrialResult run(const Spec& spec, int most_frames) override;
  std::vector<Case> others(const Spec& spec) override;

 private:
  std::vector<Case> others_among(const Spec& spec, const Evaluation& evaluation) const;

  std::string check_, subject_;
  Evaluator evaluator_;
  BeforeRun before_;
};

// For failures of which a candidate may end the process that runs it: each is first run in another one. What ends that
// is met as a failure of its own; all else is as the inner trial shows it.
class GuardedTrial final : public Trial {
 public:
  GuardedTrial(Trial& inner, const Isolation& isolation);
  TrialResult run(const Spec& spec, int most_frames) override;
  std::vector<Case> others(const Spec& spec) override;

 private:
  std::optional<Case> ended(const Spec& spec, const std::function<void()>& work) const;

  Trial& inner_;
  Isolation isolation_;
};

// For a crash, a timeout or memory: each candidate runs in a process of its own, up to ten times as long as the first
// did and five seconds at least. `work` is all that is done with a spec.
class EndingTrial final : public Trial {
 public:
  EndingTrial(const Expectation& family, std::function<void(const Spec&)> work, const Isolation& isolation);
  TrialResult run(const Spec& spec, int most_frames) override;
  std::vector<Case> others(const Spec&) override { return {}; }

 private:
  std::string check_, subject_;
  std::function<void(const Spec&)> work_;
  Isolation isolation_;
  bool timed_ = false;
};

}  // namespace contort
