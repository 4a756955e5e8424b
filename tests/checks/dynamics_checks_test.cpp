// joint_torque, balance, tracking_error: exemplars on either side of their limits, and motions that they do not judge.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "checks/withstands.h"
#include "tests/checks/small_character.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

class Judged {
 public:
  explicit Judged(int frames = 1) : character(small::build()), motion(small::moved_by_dynamics(character, frames)) {}
  const Joint& joint(const std::string& name) const { return small::joint_of(character, name); }
  double& effort(const std::string& name, std::size_t component = 0) {
    return motion.response.efforts[small::freedom_of(character, joint(name)) + component];
  }
  double margin(const std::string& check, const std::string& subject) const {
    return small::margin_of(check, character, motion, subject);
  }
  Character character;
  Motion motion;
};

TEST(JointTorque, StrengthIsJudgedInTheDirectionOfTheEffort) {
  Judged judged;
  const Joint& lift = judged.joint("arm_left/lift");
  judged.effort("arm_left/lift") = 0.75 * lift.strength_high;
  EXPECT_NEAR(judged.margin("joint_torque", "arm_left/lift"), 0.25, 1e-12);
  judged.effort("arm_left/lift") = 1.5 * lift.strength_low;
  EXPECT_NEAR(judged.margin("joint_torque", "arm_left/lift"), -0.5, 1e-12);
  EXPECT_NEAR(judged.margin("joint_torque", "arm_right/lift"), 1.0, 1e-12);
}

TEST(JointTorque, OfABallTheWorstComponentCounts) {
  Judged judged;
  judged.effort("arm_left/wrist", 2) = 2.0 * judged.joint("arm_left/wrist").strength_high;
  EXPECT_NEAR(judged.margin("joint_torque", "arm_left/wrist"), -1.0, 1e-12);
}

TEST(JointTorque, AnEffortThatIsNotANumberIsViolated) {
  Judged judged;
  judged.effort("arm_left/lift") = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(judged.margin("joint_torque", "arm_left/lift")));
}

TEST(Balance, TheZeroMomentPointsMarginCountsWhileTheFigureStands) {
  Judged judged;
  judged.motion.response.stances[0].margin_m = 0.02;
  EXPECT_EQ(judged.margin("balance", "figure"), 0.02);
  judged.motion.response.stances[0].margin_m = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(judged.margin("balance", "figure"), -1.0);
}

TEST(Balance, TippingAndFallingAreViolationsAndFallingIsTheWorst) {
  Judged judged;
  Stance& stance = judged.motion.response.stances[0];
  stance = {Footing::tipping, false, 3, 0, {}, 0.1};
  const double tipping = judged.margin("balance", "figure");
  stance.footing = Footing::airborne;
  const double airborne = judged.margin("balance", "figure");
  stance.footing = Footing::fallen;
  const double fallen = judged.margin("balance", "figure");
  EXPECT_LT(tipping, 0.0);
  EXPECT_LT(airborne, tipping);
  EXPECT_LT(fallen, airborne);
}

TEST(Balance, AFlightThatTheTargetMeansIsNotJudged) {
  Judged judged;
  judged.motion.response.stances[0] = {Footing::airborne, false, 0, 0, {}, 0.0};
  EXPECT_GT(judged.margin("balance", "figure"), 1e9);
  judged.motion.response.stances[0].footing = Footing::fallen;
  EXPECT_EQ(judged.margin("balance", "figure"), -1.0);
}

// 60 frames a second: 0.7 s are 42 frames.
TEST(TrackingError, IsJudgedFromSevenTenthsOfASecondAfterAnImpactOn) {
  for (const int frame : {41, 42}) {
    Judged judged(60);
    judged.motion.response.impacts = {{0, 1, {}, {}}};
    small::set(judged.motion, frame, judged.joint("arm_left/lift"), 4.0 * kRadPerDeg);
    EXPECT_NEAR(judged.margin("tracking_error", "arm_left/lift"), (frame == 41 ? 3.0 : -1.0) * kRadPerDeg, 1e-12);
  }
}

TEST(TrackingError, BallsAreJudgedByTheirAngleAndTravelsInMetres) {
  Judged judged(60);
  judged.motion.response.impacts = {{0, 1, {}, {}}};
  small::set(judged.motion, 50, judged.joint("arm_left/wrist"), axis_angle(Vec3(0, 0, 1), 5.0 * kRadPerDeg));
  small::set(judged.motion, 50, judged.joint("arm_left/slide"), 0.012);
  EXPECT_NEAR(judged.margin("tracking_error", "arm_left/wrist"), -2.0 * kRadPerDeg, 1e-9);
  EXPECT_NEAR(judged.margin("tracking_error", "arm_left/slide"), -0.002, 1e-12);
}

TEST(TrackingError, WhatControlDoesForLoadsAndBalanceIsNoError) {
  Judged judged(60);
  judged.motion.response.impacts = {{0, 1, {}, {}}};
  small::set(judged.motion, 50, judged.joint("arm_left/lift"), 0.4);
  judged.motion.response.control[50 * static_cast<std::size_t>(judged.motion.response.dof_count)] = 0.1;
  EXPECT_GT(judged.margin("tracking_error", "arm_left/lift"), 0.0);
}

TEST(DynamicsChecks, OnlyTheLossOfBalanceIsAFindingFromThenOn) {
  for (const int lost : {3, 8}) {
    Judged judged(10);
    small::set(judged.motion, 5, judged.joint("arm_left/lift"), 2.0);
    judged.motion.response.stances[static_cast<std::size_t>(lost)].footing = Footing::tipping;
    StageEvaluator evaluator;
    std::set<std::string> checks;
    for (const Finding& finding : evaluator.judge(judged.character, judged.motion)) checks.insert(finding.check);
    EXPECT_TRUE(checks.contains("balance"));
    EXPECT_EQ(checks.contains("joint_range"), lost == 8);
  }
}

// The figure is at rest, so it withstands the push that follows from its mass, height and soles.
TEST(DynamicsChecks, JudgeNothingAfterABlowThatIsHarderThanTheFigureWithstands) {
  Judged judged(60);
  const double withstands = withstands_N_s(judged.character, judged.motion, 10, Vec3(0.0, 0.0, 1.0));
  ASSERT_GT(withstands, 0.1);
  for (const double share : {0.99, 1.01}) {
    judged.motion.response.impacts = {{10, 1, {}, Vec3(0.0, -1e3, share * withstands)}};
    judged.motion.response.stances[30].footing = Footing::fallen;
    small::set(judged.motion, 55, judged.joint("arm_left/lift"), 4.0 * kRadPerDeg);
    EXPECT_EQ(judged.margin("balance", "figure") < 0.0, share < 1.0);
    EXPECT_EQ(judged.margin("tracking_error", "arm_left/lift") < 0.0, share < 1.0);
    judged.motion.response.stances[5].footing = Footing::fallen;
    EXPECT_LT(judged.margin("balance", "figure"), 0.0) << "before the blow";
    judged.motion.response.stances[5].footing = Footing::standing;
  }
}

TEST(DynamicsChecks, JudgeNothingInKinematicMotions) {
  const Character character = small::build();
  const Motion motion = small::at_rest(character, 60);
  EXPECT_GT(small::margin_of("joint_torque", character, motion, "arm_left/lift"), 1e9);
  EXPECT_GT(small::margin_of("balance", character, motion, "figure"), 1e9);
  EXPECT_GT(small::margin_of("tracking_error", character, motion, "arm_left/lift"), 1e9);
}

}  // namespace
}  // namespace contort
