// The one path from an Execution to findings; the fuzzer, the shrinker, replay and the command line all take it.
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
  std::vector<NotJudged> not_judged;  // with `only_check`, both tell of it alone
  std::vector<WaivedFinding> waived;
  std::vector<WaiverUse> waivers;  // for each waiver of the settings
  bool operator==(const Evaluation&) const = default;
};

// A motion came so near to the limits of one check: the smallest margin of each subject, in the subject's unit;
// +infinity where it was not judged.
struct SmallestMargins {
  const CheckDef* check = nullptr;
  std::vector<double> of_subject;
};

// The margins of one subject over a motion, for people to look at.
struct MarginCurve {
  const CheckDef* check = nullptr;
  Subject subject;
  std::vector<double> margins;  // by frame; +infinity where it was not judged
};

// Owns the memory of one thread's judgements; nothing of one judgement reaches the next.
class Judge {
 public:
  explicit Judge(CheckSettings settings = {}) : settings_(settings) {}

  // Measures, folds, and sets apart what waivers hide. With `only_check`, that check alone: the shrinker asks for
  // nothing else.
  Evaluation evaluate(const Execution& execution, std::string_view only_check = {});

  // The findings alone, waived ones among them, of a motion from elsewhere; without surroundings, on level ground at
  // height 0; without an intent, promises are not judged.
  std::vector<Finding> judge(const Character& character, const Motion& motion, std::string_view only_check = {},
                             const Environment& environment = {}, const Intent* intent = nullptr);

  // The margins of the last judgement, in the manifest's order, of all checks of motions, whether they could judge or
  // not. The search is guided by them.
  const std::vector<SmallestMargins>& smallest_margins() const { return smallest_; }
  // The curves of the last judgement, which was of this execution and had all checks: first the subject that a finding
  // is about, then those that came nearest to their limits in the check's scale, `most` at the most.
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
