// aim_error: exemplars on either side of the limit, and the aims that the generator declares.
#include <gtest/gtest.h>

#include "tests/checks/small_character.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::use;

// The character turned by an angle about the vertical, while a socket should point along +Z.
double margin_when_turned(double angle_deg, bool declared = true) {
  const Character character = small::build();
  Motion motion = small::at_rest(character, 3);
  const int socket = character.find_socket("arm_left/inside");
  const Rigid turn{axis_angle(Vec3(0, 1, 0), angle_deg * kRadPerDeg), Vec3(0.0)};
  for (Rigid& root : motion.root) root = turn * root;
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, motion.root[0], motion.row(0), world);
  const Vec3 at = world_from_socket(character, world, socket).p_m;
  if (declared) motion.aims = {{1, 2, socket, at + Vec3(0.0, 0.0, 7.0)}};
  return small::margin_of("aim_error", character, motion, "arm_left/inside");
}

TEST(AimError, ATenthOfADegreeIsTheLimit) {
  EXPECT_GT(margin_when_turned(0.0999), 0.0);
  EXPECT_LT(margin_when_turned(0.1001), 0.0);
  EXPECT_NEAR(margin_when_turned(0.0), 0.1 * kRadPerDeg, 1e-9);
  EXPECT_NEAR(margin_when_turned(-30.0), -29.9 * kRadPerDeg, 1e-9);
  EXPECT_NEAR(margin_when_turned(180.0), -179.9 * kRadPerDeg, 1e-6);
}

TEST(AimError, WhatDoesNotAimIsNotJudged) { EXPECT_GT(margin_when_turned(90.0, false), 1e9); }

TEST(AimError, ATargetInThePointItselfIsViolated) {
  const Character character = small::build();
  Motion motion = small::at_rest(character, 1);
  const int socket = character.find_socket("arm_left/inside");
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, motion.root[0], motion.row(0), world);
  motion.aims = {{0, 0, socket, world_from_socket(character, world, socket).p_m}};
  StageEvaluator evaluator;
  const Intent intent;
  const std::vector<Finding> findings = evaluator.judge(character, motion, "aim_error", {}, &intent);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_TRUE(std::isnan(findings[0].worst_margin));
}

Evaluation played(const std::vector<ActionUse>& actions, Motion* motion = nullptr) {
  StageEvaluator evaluator;
  const Stage stage = fixtures::stage_of({fixtures::sequence(actions)});
  const Evaluation evaluation = evaluator.run(stage, "aim_error");
  if (motion != nullptr) *motion = evaluator.motion();
  return evaluation;
}

ActionUse head_aims_at(const Vec3& target_m) {
  ActionUse aim = use("aim", "head", 0, 60, {{"target_m", target_m}});
  aim.blend_in_frames = 20, aim.blend_out_frames = 10;
  return aim;
}

TEST(AimError, OutOfReachIsAnUnmetRequestAndNoFinding) {
  StageEvaluator evaluator;
  const auto unmet_of = [&](std::vector<ActionUse> uses) {
    EXPECT_TRUE(evaluator.run(fixtures::stage_of({fixtures::sequence(std::move(uses))}), "aim_error").findings.empty());
    return evaluator.execution().intent->unmet;
  };
  EXPECT_TRUE(unmet_of({head_aims_at(Vec3(1.0, 1.2, 3.0))}).empty());
  const Vec3 behind(0.0, 1.5, -3.0);
  const std::vector<UnmetRequest> hurried = unmet_of({head_aims_at(behind)});
  const int head = evaluator.execution().character->find_part("head");
  // The request is unmet in the last frame before it fades, because until then the figure is turning.
  EXPECT_EQ(hurried, (std::vector{UnmetRequest{50, 50, head, "aim", Shortfall::joint_speed}}));
  // If neither torso nor legs may help, it is unmet from the frame on in which the aim is blended in.
  const std::vector<UnmetRequest> alone = unmet_of({head_aims_at(behind), use("look_at", "torso", 0, 60, {}),
                                                    use("crouch", "waist", 0, 60, {{"share", 0.05}})});
  EXPECT_EQ(alone, (std::vector{UnmetRequest{20, 50, head, "aim", Shortfall::out_of_reach}}));
}

TEST(AimError, AnAimThatIsDisturbedOnPurposeIsNotJudged) {
  Motion motion;
  const auto blow = [](int start) {
    return use("hit_reaction", "head", start, 10, {{"azimuth_deg", 90.0}, {"strength_deg", 10.0}});
  };
  EXPECT_TRUE(played({head_aims_at(Vec3(1.0, 1.2, 3.0)), blow(25)}, &motion).findings.empty());
  ASSERT_EQ(motion.aims.size(), 2U);
  EXPECT_EQ(motion.aims[0].last_frame, 24);
  EXPECT_EQ(motion.aims[1].first_frame, 36);
  const ActionUse look = use("look_at", "head", 30, 30, {{"target_m", Vec3(-2.0, 1.5, 1.0)}});
  EXPECT_TRUE(played({head_aims_at(Vec3(1.0, 1.2, 3.0)), look}).findings.empty());
}

}  // namespace
}  // namespace contort
