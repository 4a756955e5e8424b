// Actions keep the ranges and speeds of joints by themselves, and list the requests that they could not meet.
#include <gtest/gtest.h>

#include <algorithm>

#include "generator/execute.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::stage_of;
using fixtures::use;

ActionUse look_aside(int blend_in_frames) {
  ActionUse look = use("look_at", "head", 0, 90, {{"target_m", Vec3(2.0, 1.5, 2.0)}});
  look.blend_in_frames = blend_in_frames;
  return look;
}

std::vector<Finding> findings_of(const ActionUse& action) {
  StageEvaluator evaluator;
  return evaluator.run(stage_of({sequence({action})}, 10)).findings;
}

TEST(Promises, ACourseComesInOverTheTimeThatItsWayNeeds) {
  EXPECT_EQ(ActionUse{}.blend_in_frames, -1);
  EXPECT_TRUE(findings_of(look_aside(-1)).empty());
}

TEST(Promises, ABlendOfNoFramesIsACutThatPops) {
  const std::vector<Finding> findings = findings_of(look_aside(0));
  EXPECT_TRUE(std::ranges::any_of(findings, [](const Finding& finding) { return finding.check == "pop"; }));
}

TEST(Promises, ABlendThatIsTooShortIsBroughtUpWithinTheSpeedsOfTheJoints) {
  EXPECT_TRUE(findings_of(look_aside(1)).empty());
}

TEST(Promises, APoseThatIsTooQuickArrivesLaterAndSaysSo) {
  const Stage stage = stage_of({sequence({fixtures::elbow(0, 4, 100.0)})}, 40);
  StageEvaluator evaluator;
  EXPECT_TRUE(evaluator.run(stage).findings.empty());
  const Motion motion = generate(stage);
  EXPECT_EQ(fixtures::coord(motion, 44, *stage.character, "arm_left/elbow"), 100.0 * kRadPerDeg);
  const Intent intent = intent_of(stage);
  ASSERT_EQ(intent.unmet.size(), 1U);
  EXPECT_EQ(intent.unmet[0].why, Shortfall::joint_speed);
}

// A foot on its quick way back passes the other one: no frame shows it, but the way between two did.
TEST(Promises, AFootPassesThroughNothingBetweenFrames) {
  for (const double aside_m : {0.12, 0.16, 0.2})
    for (const int frames : {20, 24, 28}) {
      ActionUse reach = use("reach", "leg_right", 0, frames, {{"target_m", Vec3(aside_m, 0.96, -0.16)},
                                                              {"swivel_deg", -180.0}});
      reach.blend_in_frames = -1;
      for (const Finding& finding : findings_of(reach))
        EXPECT_NE(finding.check, "self_collision") << aside_m << " m in " << frames << ": " << finding.subject;
    }
}

TEST(Promises, AHeadThatIsToFaceBackwardsTurnsAsFarAsItsRangeAndSaysSo) {
  const Stage stage = stage_of({sequence({use("direction", "head", 0, 60, {{"azimuth_deg", 170.0}})})}, 10);
  StageEvaluator evaluator;
  EXPECT_TRUE(evaluator.run(stage).findings.empty());
  const Intent intent = intent_of(stage);
  ASSERT_EQ(intent.unmet.size(), 1U);
  EXPECT_EQ(intent.unmet[0].why, Shortfall::joint_range);
}

}  // namespace
}  // namespace contort
