// angular_velocity: speeds between two frames just inside and just outside of each joint's own limit.
#include <gtest/gtest.h>

#include "tests/checks/small_character.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

constexpr double kStep = 1e-6;  // rad/s or m/s

class AngularVelocity : public testing::Test {
 protected:
  template <class Value>
  double margin(const std::string& joint, const Value& before, const Value& now, double rate_hz = 60.0) {
    Motion motion = small::at_rest(character_, 2, rate_hz);
    small::set(motion, 0, small::joint_of(character_, joint), before);
    small::set(motion, 1, small::joint_of(character_, joint), now);
    return small::margin_of("angular_velocity", character_, motion, joint);
  }
  Character character_ = small::build();
};

TEST_F(AngularVelocity, HingeEndsAtItsLimitInBothDirections) {
  const double limit = 300 * kRadPerDeg;
  for (const std::string joint : {"arm_left/lift", "arm_right/lift"})
    for (const double sign : {-1.0, 1.0})
      for (const double step : {-kStep, kStep})
        EXPECT_NEAR(margin(joint, 0.1, 0.1 + sign * (limit - step) / 60.0), step, 1e-12) << joint;
}

TEST_F(AngularVelocity, ExactlyAtTheLimitIsSafe) {
  // 2 m/s at 64 Hz is a step of 1/32 m: all exact in binary.
  EXPECT_EQ(margin("arm_left/slide", 0.0, 1.0 / 32.0, 64.0), 0.0);
  Motion motion = small::at_rest(character_, 2, 64.0);
  small::set(motion, 1, small::joint_of(character_, "arm_left/slide"), 1.0 / 32.0);
  StageEvaluator evaluator;
  EXPECT_TRUE(evaluator.judge(character_, motion, "angular_velocity").empty());
  EXPECT_LT(margin("arm_left/slide", 0.0, std::nextafter(1.0 / 32.0, 1.0), 64.0), 0.0);
  // Findings begin one resolution (1e-6 m/s) beyond.
  small::set(motion, 1, small::joint_of(character_, "arm_left/slide"), 1.0 / 32.0 + 0.9e-6 / 64.0);
  EXPECT_TRUE(evaluator.judge(character_, motion, "angular_velocity").empty());
  small::set(motion, 1, small::joint_of(character_, "arm_left/slide"), 1.0 / 32.0 + 1.1e-6 / 64.0);
  EXPECT_EQ(evaluator.judge(character_, motion, "angular_velocity").size(), 1U);
}

TEST_F(AngularVelocity, PrismaticIsInMetresPerSecond) {
  for (const double step : {-kStep, kStep})
    EXPECT_NEAR(margin("arm_right/slide", 0.0, -(2.0 - step) / 60.0), step, 1e-12);
  const CheckDef& check = small::check_named("angular_velocity");
  EXPECT_EQ(check.subject(character_, 0).unit, "m/s");
  EXPECT_EQ(check.subject(character_, 1).unit, "rad/s");
  EXPECT_EQ(check.subject(character_, 2).unit, "rad/s");
}

TEST_F(AngularVelocity, BallTurnsByTheAngleOfItsRotation) {
  const double limit = 400 * kRadPerDeg;
  const Quat before = from_rotation_vector({0.3, -0.2, 0.5});
  const Vec3 about = Vec3(2, -1, 2) / 3.0;
  for (const double step : {-kStep, kStep}) {
    const Quat now = before * axis_angle(about, (limit - step) / 60.0);
    EXPECT_NEAR(margin("arm_left/wrist", before, now), step, 1e-12);
    EXPECT_NEAR(margin("arm_left/wrist", before, -now), step, 1e-12);
    EXPECT_NEAR(margin("arm_left/wrist", -before, now), step, 1e-12);
    EXPECT_NEAR(margin("arm_left/wrist", now, before), step, 1e-12);
  }
}

TEST_F(AngularVelocity, BallThatOnlyChangesItsSignStandsStill) {
  const Quat q = from_rotation_vector({0.3, -0.2, 0.5});
  EXPECT_NEAR(margin("arm_left/wrist", q, -q), 400 * kRadPerDeg, 1e-12);
}

TEST_F(AngularVelocity, BallTurnsTheShortWay) {  // 350 degrees one way are 10 the other
  const Quat now = axis_angle(Vec3(0, 1, 0), 350 * kRadPerDeg);
  EXPECT_NEAR(margin("arm_left/wrist", kNoRotation, now, 10.0), 300 * kRadPerDeg, 1e-11);
}

TEST_F(AngularVelocity, SpeedGrowsWithTheFrameRate) {
  EXPECT_NEAR(margin("arm_left/lift", 0.0, 0.01, 30.0), 300 * kRadPerDeg - 0.3, 1e-12);
  EXPECT_NEAR(margin("arm_left/lift", 0.0, 0.01, 120.0), 300 * kRadPerDeg - 1.2, 1e-12);
}

TEST_F(AngularVelocity, IsReportedAtTheFrameThatWasReached) {
  Motion motion = small::at_rest(character_, 6);
  const double lift_rad[] = {0.0, 0.0, 0.03, 0.13, 0.16, 0.16};  // 1.8, 6 and 1.8 rad/s
  for (int f = 0; f < 6; ++f) small::set(motion, f, small::joint_of(character_, "arm_left/lift"), lift_rad[f]);
  StageEvaluator evaluator;
  const std::vector<Finding> findings = evaluator.judge(character_, motion, "angular_velocity");
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].subject, "arm_left/lift");
  EXPECT_EQ(findings[0].first_frame, 3);
  EXPECT_EQ(findings[0].last_frame, 3);
  EXPECT_NEAR(findings[0].depth, 6.0 - 300 * kRadPerDeg, 1e-12);  // the scale is 1 rad/s
}

TEST_F(AngularVelocity, OneFrameHasNoSpeed) {
  StageEvaluator evaluator;
  EXPECT_TRUE(evaluator.judge(character_, small::at_rest(character_, 1), "angular_velocity").empty());
}

TEST_F(AngularVelocity, ANumberThatIsNoneIsAFindingInBothFramesThatItTouches) {
  Motion motion = small::at_rest(character_, 4);
  const double bad = std::numeric_limits<double>::quiet_NaN();
  small::set(motion, 1, small::joint_of(character_, "arm_left/lift"), bad);
  small::set(motion, 1, small::joint_of(character_, "arm_right/wrist"), Quat(1, 0, bad, 0));
  StageEvaluator evaluator;
  const std::vector<Finding> findings = evaluator.judge(character_, motion, "angular_velocity");
  ASSERT_EQ(findings.size(), 2U);
  for (const Finding& f : findings) {
    EXPECT_TRUE(std::isnan(f.worst_margin)) << f.subject;
    EXPECT_EQ(f.first_frame, 1);
    EXPECT_EQ(f.last_frame, 2);
  }
}

}  // namespace

}  // namespace contort
