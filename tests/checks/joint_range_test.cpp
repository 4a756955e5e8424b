// joint_range: just inside (+1e-6) and just outside (-1e-6) of every limit, left as authored and right mirrored.
#include <gtest/gtest.h>

#include <random>

#include "tests/checks/small_character.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

constexpr double kRangeStep = 1e-6;

class JointRange : public testing::Test {
 protected:
  double margin(const std::string& joint, double value, const std::string& side) {
    Motion motion = small::at_rest(character_);
    small::set(motion, 0, small::joint_of(character_, joint), value);
    return small::margin_of("joint_range", character_, motion, joint + " " + side);
  }
  double margin(const std::string& joint, const Quat& q, const std::string& side) {
    Motion motion = small::at_rest(character_);
    small::set(motion, 0, small::joint_of(character_, joint), q);
    return small::margin_of("joint_range", character_, motion, joint + " " + side);
  }
  // The left wrist's rotation that swings by a vector and twists, both seen from the limit frame.
  Quat wrist(const Vec3& swing_rad, double twist_rad) {
    const Joint& joint = small::joint_of(character_, "arm_left/wrist");
    return joint.swing_center * from_rotation_vector(swing_rad) * axis_angle(joint.axis, twist_rad);
  }
  // Both arms: the same posture must have the same margin.
  void expect_wrist_margin(const Quat& q, const std::string& side, double expected) {
    EXPECT_NEAR(margin("arm_left/wrist", q, side), expected, 1e-12) << side;
    EXPECT_NEAR(margin("arm_right/wrist", mirror_rotation(q), side), expected, 1e-12) << side << " mirrored";
    EXPECT_NEAR(margin("arm_left/wrist", -q, side), expected, 1e-12) << side << " with the other sign";
  }
  Character character_ = small::build();
};

TEST_F(JointRange, HingeEndsAtItsLimits) {
  const double low = -20 * kRadPerDeg, high = 50 * kRadPerDeg;
  for (const std::string arm : {"arm_left/lift", "arm_right/lift"}) {
    EXPECT_EQ(margin(arm, high, "max"), 0.0);
    EXPECT_NEAR(margin(arm, high - kRangeStep, "max"), kRangeStep, 1e-15);
    EXPECT_NEAR(margin(arm, high + kRangeStep, "max"), -kRangeStep, 1e-15);
    EXPECT_NEAR(margin(arm, low + kRangeStep, "min"), kRangeStep, 1e-15);
    EXPECT_NEAR(margin(arm, low - kRangeStep, "min"), -kRangeStep, 1e-15);
  }
}

TEST_F(JointRange, PrismaticEndsAtItsLimits) {
  for (const std::string arm : {"arm_left/slide", "arm_right/slide"}) {
    EXPECT_NEAR(margin(arm, 0.1 - kRangeStep, "max"), kRangeStep, 1e-15);
    EXPECT_NEAR(margin(arm, 0.1 + kRangeStep, "max"), -kRangeStep, 1e-15);
    EXPECT_NEAR(margin(arm, -0.25 + kRangeStep, "min"), kRangeStep, 1e-15);
    EXPECT_NEAR(margin(arm, -0.25 - kRangeStep, "min"), -kRangeStep, 1e-15);
  }
}

TEST_F(JointRange, BallSwingsUpToBothHalfAngles) {
  const Vec3 a_axis(1, 0, 0);
  const Vec3 b_axis = glm::cross(Vec3(0, -1, 0), a_axis);
  const double a = 35 * kRadPerDeg, b = 80 * kRadPerDeg;
  for (const double sign : {-1.0, 1.0})
    for (const double step : {-kRangeStep, kRangeStep}) {
      expect_wrist_margin(wrist(sign * (a - step) * a_axis, 0.3), "swing", step);
      expect_wrist_margin(wrist(sign * (b - step) * b_axis, -0.3), "swing", step);
    }
}

TEST_F(JointRange, BallSwingBetweenTheAxesIsAnEllipseOfAngles) {
  const double a = 35 * kRadPerDeg, b = 80 * kRadPerDeg;
  for (int i = 0; i < 16; ++i) {
    const double t = i * kPi / 8.0;
    const Vec3 on_edge = a * std::cos(t) * Vec3(1, 0, 0) + b * std::sin(t) * glm::cross(Vec3(0, -1, 0), Vec3(1, 0, 0));
    const double length = std::sqrt(glm::dot(on_edge, on_edge));
    for (const double step : {-kRangeStep, kRangeStep})
      expect_wrist_margin(wrist(on_edge * (1.0 - step / length), 0.1), "swing", step);
  }
}

TEST_F(JointRange, BallTwistsBetweenItsLimits) {
  const double low = -40 * kRadPerDeg, high = 60 * kRadPerDeg;
  const Vec3 swing(0.2, 0.0, 0.5);
  for (const double step : {-kRangeStep, kRangeStep}) {
    expect_wrist_margin(wrist(swing, low + step), "twist min", step);
    expect_wrist_margin(wrist(swing, high - step), "twist max", step);
  }
}

TEST_F(JointRange, BallInTheMiddleHasTheNarrowerHalfAngleLeft) {
  expect_wrist_margin(wrist(Vec3(0.0), 0.0), "swing", 35 * kRadPerDeg);
}

// Near the middle of the cone the direction of the swing turns quickly; the margin must not jump there by more than
// the two half angles differ, and must be the ellipse's radius in that direction.
TEST_F(JointRange, BallNextToTheMiddleIsJudgedByTheDirectionOfItsSwing) {
  const Vec3 b_axis = glm::cross(Vec3(0, -1, 0), Vec3(1, 0, 0));
  EXPECT_NEAR(margin("arm_left/wrist", wrist(1e-6 * b_axis, 0.0), "swing"), 80 * kRadPerDeg - 1e-6, 1e-9);
}

// Composes rotations from any swing and any twist, which the check must separate again. Greatest measured error:
// 5.3e-15 rad.
TEST_F(JointRange, BallTakesSwingAndTwistApartAsTheyWerePutTogether) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> angle(-kPi, kPi), size(0.01, 3.0), twist(-3.1, 3.1);
  for (int i = 0; i < 5000; ++i) {
    const double direction = angle(engine), s = size(engine), t = twist(engine);
    const Quat q = wrist(s * Vec3(std::cos(direction), 0, std::sin(direction)), t);
    ASSERT_NEAR(margin("arm_left/wrist", q, "twist min"), t + 40 * kRadPerDeg, 1e-13) << i;
    ASSERT_NEAR(margin("arm_left/wrist", q, "twist max"), 60 * kRadPerDeg - t, 1e-13) << i;
    const double c = std::cos(direction) / (35 * kRadPerDeg), d = std::sin(direction) / (80 * kRadPerDeg);
    ASSERT_NEAR(margin("arm_left/wrist", q, "swing"), 1.0 / std::sqrt(c * c + d * d) - s, 1e-13) << i;
  }
}

TEST_F(JointRange, EveryCoordinateThatIsNotANumberIsAFinding) {
  const double bad = std::numeric_limits<double>::quiet_NaN();
  for (const Joint& joint : character_.joints())
    for (int c = 0; c < coord_size(joint.kind); ++c) {
      Motion motion = small::at_rest(character_);
      motion.row(0)[static_cast<std::size_t>(joint.coord + c)] = bad;
      StageEvaluator evaluator;
      const std::vector<Finding> findings = evaluator.judge(character_, motion, "joint_range");
      EXPECT_EQ(findings.size(), joint.kind == JointKind::ball ? 3U : 2U) << joint.name;
      for (const Finding& f : findings) EXPECT_TRUE(std::isnan(f.worst_margin) && std::isinf(f.depth)) << f.subject;
    }
}

TEST_F(JointRange, NamesItsSubjectsAfterJointAndSide) {
  const std::vector<std::string> expected = {
      "arm_left/slide min",        "arm_left/slide max",       "arm_left/lift min",        "arm_left/lift max",
      "arm_left/wrist swing",      "arm_left/wrist twist min", "arm_left/wrist twist max", "arm_right/slide min",
      "arm_right/slide max",       "arm_right/lift min",       "arm_right/lift max",       "arm_right/wrist swing",
      "arm_right/wrist twist min", "arm_right/wrist twist max"};
  EXPECT_EQ(small::subjects_of("joint_range", character_), expected);
}

}  // namespace

}  // namespace contort
