// Turns an Execution into findings. The fuzzer, the shrinker, replay and the command line all use this one path.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "checks/check.h"
#include "checks/waive.h"
#include "model/motion/execution.h"

namespace contort {

// A finding that a waiver of the settings hides.
struct WaivedFinding {
  Finding finding;
  int waiver = 0;  // index into the settings
  bool operator==(const WaivedFinding&) const = default;
};

struct Evaluation {
  std::uint64_t motion_hash = 0;
  int frame_count = 0;
  std::vector<Finding> findings;  // by first frame, then check in the manifest's order, then subject
  std::vector<JudgedCheck> judged;    // in the manifest's order, like the next
  std::vector<NotJudged> not_judged;  // with `only_check`, both lists contain only that check
  std::vector<WaivedFinding> waived;
  std::vector<WaiverUse> waivers;  // for each waiver of the settings
  bool operator==(const Evaluation&) const = default;
};

// The distance of a motion from the limits of one check: the smallest margin of each subject, in the subject's unit;
// +infinity if it was not judged.
struct SmallestMargins {
  const CheckDef* check = nullptr;
  std::vector<double> of_subject;
};

// The margins of one subject over a motion, for display.
struct MarginCurve {
  const CheckDef* check = nullptr;
  Subject subject;
  std::vector<double> margins;  // by frame; +infinity where it was not judged
};

// Judges executions, and owns the memory that one thread needs for it. Nothing of one judgement affects the next.
class Judge {
 public:
  explicit Judge(CheckSettings settings = {}) : settings_(settings) {}

  // Measures margins, folds them, and separates the findings that waivers hide. With `only_check`, it runs that check
  // only; the shrinker uses this.
  Evaluation evaluate(const Execution& execution, std::string_view only_check = {});

  // Returns only the findings, including waived ones, of a motion made elsewhere. Without surroundings the ground is
  // level at height 0. Without an intent, checks that need one do not judge.
  std::vector<Finding> judge(const Character& character, const Motion& motion, std::string_view only_check = {},
                             const Environment& environment = {}, const Intent* intent = nullptr);

  // The smallest margins of the last judgement, in the manifest's order, of all checks of motions, whether they could
  // judge or not. They guide the search.
  const std::vector<SmallestMargins>& smallest_margins() const { return smallest_; }
  // The curves of the last judgement, which must be of this execution and of all checks. The first is that of the
  // finding's subject; then follow the subjects nearest to their limits in the check's scale, at most `most` in all.
  std::vector<MarginCurve> curves(const Execution& execution, const Finding& about, std::size_t most) const;

 private:
  void judge(CheckInput input, std::string_view only_check, Evaluation& out);
  void set_waived_apart(const Execution& execution, Evaluation& evaluation) const;
  MarginFold fold(const CheckDef& check, const CheckInput& input, bool record) const;

  CheckSettings settings_;
  std::vector<Rigid> world_;
  std::vector<SmallestMargins> smallest_;
};

// The deepest finding of a check and subject, or nullptr.
const Finding* deepest(const std::vector<Finding>& findings, const std::string& check, const std::string& subject);

}  // namespace contort
