// Runs specs to see whether they show the family that is being shrunk, and how deeply.
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
  bool built = false;  // false if the spec was refused before any motion was made
  bool fails = false;
  int most_frames = 0;  // the greatest number of frames that the motion can have
  double depth = 0.0;   // infinite if the margin is NaN
  Expectation expect;
  std::shared_ptr<const Character> character;  // null if the generator runs in another process
  std::vector<ActionSpan> spans;               // the actions that moved parts, and their frames
  std::vector<Case> met;                       // failures of other families that the same motions showed
  BaseShows base = BaseShows::passes_check;    // the base's result, for a failure that counts against it
  std::string base_hash{};                     // hash of the base's motion
};

// Called with each spec, in the process that runs the spec and before it runs. If the process ends, the notes of this
// call are the last ones.
using BeforeRun = std::function<void(const Spec&)>;

class Trial {
 public:
  virtual ~Trial() = default;
  // A motion of more than `most_frames` is refused before it is generated.
  virtual TrialResult run(const Spec& spec, int most_frames) = 0;
  // Failures of all other families in the motion of the spec that was run last, the deepest of each.
  virtual std::vector<Case> others(const Spec& spec) = 0;
};

// Runs specs for a failure that a check found. Only this check is measured.
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

// Runs specs for failures whose candidates may end their process: each candidate first runs in another process. If it
// ends that process, it is listed as a failure of its own; otherwise the result is that of the inner trial. If the
// generator is a program of its own, only that program can end, and no other process is needed.
class GuardedTrial final : public Trial {
 public:
  GuardedTrial(Trial& inner, const Isolation& isolation, bool is_own_program = false);
  TrialResult run(const Spec& spec, int most_frames) override;
  std::vector<Case> others(const Spec& spec) override;

 private:
  std::optional<Case> ended(const Spec& spec, const std::function<void()>& work) const;
  TrialResult run_here(const Spec& spec, int most_frames);

  Trial& inner_;
  Isolation isolation_;
  bool is_own_program_;
};

// Runs specs for a crash, a timeout or a memory failure: each candidate runs in a process of its own, for ten times as
// long as the first one took and at least five seconds. `work` does everything that is done with a spec.
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
