// Every check either judges a motion, or gives the reason why it cannot.
#include <gtest/gtest.h>

#include "tests/checks/small_character.h"

namespace contort {
namespace {

Execution still_small(int frames = 5) {
  Execution out;
  out.character = std::make_shared<const Character>(small::build());
  out.motion = small::at_rest(*out.character, frames);
  return out;
}

Execution meant_small(int frames = 5) {
  Execution out = still_small(frames);
  out.intent.emplace();
  return out;
}

// Why the check could not judge; "judged" where it did.
std::string reason_of(const Execution& execution, const std::string& check, const CheckSettings& settings = {}) {
  const Evaluation evaluation = Judge(settings).evaluate(execution);
  for (const NotJudged& one : evaluation.not_judged)
    if (one.check == check) return std::string(one.reason);
  for (const JudgedCheck& one : evaluation.judged)
    if (one.check == check) return one.subjects > 0 ? "judged" : "judged nothing";
  return "missing";
}

TEST(CheckNotJudged, EveryCheckIsInOneOfTheTwoLists) {
  for (const Execution& execution : {still_small(), meant_small(), still_small(0), still_small(1)}) {
    const Evaluation evaluation = Judge().evaluate(execution);
    EXPECT_EQ(evaluation.judged.size() + evaluation.not_judged.size(), all_checks().size());
    for (const CheckDef& check : all_checks()) {
      EXPECT_NE(reason_of(execution, std::string(check.name)), "missing") << check.name;
      EXPECT_NE(reason_of(execution, std::string(check.name)), "") << check.name;
    }
  }
}

TEST(CheckNotJudged, PromisesNeedAnIntent) {
  for (const char* check : {"reach_error", "aim_error", "residue", "stuck", "queue_gap"}) {
    EXPECT_EQ(reason_of(still_small(), check), "nothing says what the motion was meant to do (no intent)") << check;
    EXPECT_NE(reason_of(meant_small(), check), "nothing says what the motion was meant to do (no intent)") << check;
  }
  EXPECT_EQ(reason_of(meant_small(), "stuck"), "judged");
  EXPECT_EQ(reason_of(meant_small(), "aim_error"), "no action aimed");
  EXPECT_EQ(reason_of(meant_small(), "reach_error"), "no limb was sent to a point");
}

TEST(CheckNotJudged, DynamicsNeedDynamicsAndTakeTheReachAway) {
  for (const char* check : {"joint_torque", "balance", "tracking_error"})
    EXPECT_EQ(reason_of(meant_small(), check), "the motion has no dynamics") << check;
  Execution moved = meant_small();
  moved.motion = small::moved_by_dynamics(*moved.character, 5);
  EXPECT_EQ(reason_of(moved, "joint_torque"), "judged");
  EXPECT_EQ(reason_of(moved, "balance"), "judged");
  EXPECT_EQ(reason_of(moved, "tracking_error"), "no blow that it must withstand was long enough before the end");
  EXPECT_EQ(reason_of(moved, "reach_error"), "dynamics moves the figure, so that tracking_error judges");
}

TEST(CheckNotJudged, TheGroundNeedsAHeightAndFeetNeedAPath) {
  Execution execution = still_small();
  EXPECT_EQ(reason_of(execution, "ground_penetration"), "judged");
  execution.path = RootPath::on_the_spot;
  EXPECT_EQ(reason_of(execution, "ground_penetration"), "judged");
  EXPECT_EQ(reason_of(execution, "foot_slide"), "the figure walks on the spot: an engine would move it");
  execution.path = RootPath::unknown;
  for (const char* check : {"ground_penetration", "foot_slide", "obstacle_penetration"})
    EXPECT_EQ(reason_of(execution, check), "nothing says where the root goes") << check;
}

TEST(CheckNotJudged, ACheckThatCouldNotJudgeFindsNothing) {
  Execution sunk = still_small();
  for (Rigid& root : sunk.motion.root) root.p_m.y -= 3.0;
  EXPECT_NE(deepest(Judge().evaluate(sunk).findings, "ground_penetration", "base"), nullptr);
  sunk.path = RootPath::unknown;
  for (const Finding& finding : Judge().evaluate(sunk).findings) EXPECT_NE(finding.check, "ground_penetration");
}

TEST(CheckNotJudged, WhatTheSettingsIgnoreIsNotJudged) {
  CheckSettings settings;
  settings.limits = {{"self_collision", "*", "", LimitUse::ignore, 0.0, "r"}};
  EXPECT_EQ(reason_of(still_small(), "self_collision"), "judged") << "though nothing is near enough to have a margin";
  EXPECT_EQ(reason_of(still_small(), "self_collision", settings), "no two bodies can collide: they are neighbours, or touch at rest");
}

TEST(CheckNotJudged, OneCheckAloneTellsOfItselfAlone) {
  const Evaluation evaluation = Judge().evaluate(still_small(), "balance");
  EXPECT_TRUE(evaluation.judged.empty());
  EXPECT_EQ(evaluation.not_judged, (std::vector<NotJudged>{{"balance", "the motion has no dynamics"}}));
}

}  // namespace
}  // namespace contort
