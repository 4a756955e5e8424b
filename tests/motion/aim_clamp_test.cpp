// clamp_to_range: in range by the check's own arithmetic, and settled after one call.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "checks/check.h"
#include "generator/motion/joint_clamp.h"
#include "tests/character/stock.h"
#include "tests/motion/aim_scenes.h"

namespace contort {
namespace {

// Anything at all: hinges up to two turns away, travels up to a metre, balls anywhere.
void draw_any(const Joint& joint, std::mt19937_64& random, double* q) {
  if (joint.kind == JointKind::ball) {
    const Quat any = glm::normalize(Quat(fixtures::uniform(random, -1, 1), fixtures::uniform(random, -1, 1),
                                         fixtures::uniform(random, -1, 1), fixtures::uniform(random, -1, 1)));
    q[0] = any.w, q[1] = any.x, q[2] = any.y, q[3] = any.z;
  } else if (joint.kind != JointKind::root) {
    q[0] = fixtures::uniform(random, -12, 12);
  }
}

// The check's smallest margin, strict.
double smallest_margin(const Character& character, Motion& motion) {
  const auto check = std::ranges::find(all_checks(), "joint_range", &CheckDef::name);
  MarginFold fold(check->subject_count(character), 0);
  const CheckSettings settings;
  const Environment level;
  check->measure({character, motion, {}, settings, level, nullptr}, fold);
  return *std::ranges::min_element(fold.smallest());
}

void expect_clamped(const Character& character) {
  std::mt19937_64 random(3);
  Motion motion;
  motion.coord_count = character.coord_count();
  motion.frame_count = 20000;
  motion.coords.resize(static_cast<std::size_t>(motion.coord_count * motion.frame_count));
  for (int frame = 0; frame < motion.frame_count; ++frame)
    for (const Joint& joint : character.joints()) {
      if (joint.kind == JointKind::root) continue;
      double* q = motion.row(frame).data() + joint.coord;
      draw_any(joint, random, q);
      clamp_to_range(joint, q);
      const std::vector<double> once(q, q + coord_size(joint.kind));
      clamp_to_range(joint, q);
      ASSERT_TRUE(std::equal(once.begin(), once.end(), q)) << joint.name;
    }
  EXPECT_GE(smallest_margin(character, motion), 0.0) << character.name();
}

TEST(AimClamp, IsInRangeAndIdempotent) {
  expect_clamped(fixtures::human());
  for (const char* arm : {"mech_arm_slim", "mech_arm_shield", "mech_arm_extend"})
    expect_clamped(fixtures::built(fixtures::mech_choice({{"arm_left", arm}, {"arm_right", arm}})));
}

TEST(AimClamp, LeavesWhatIsInRangeAsItIs) {
  std::mt19937_64 random(4);
  for (const Joint& joint : fixtures::human().joints()) {
    if (joint.kind == JointKind::root) continue;
    for (int i = 0; i < 1000; ++i) {
      double q[4];
      fixtures::draw_joint(joint, random, q);
      const std::vector<double> before(q, q + coord_size(joint.kind));
      clamp_to_range(joint, q);
      EXPECT_TRUE(std::equal(before.begin(), before.end(), q)) << joint.name;
    }
  }
}

Joint ball(double swing_a_rad, double swing_b_rad, double low_rad, double high_rad) {
  Joint joint;
  joint.kind = JointKind::ball;
  joint.axis = Vec3(0, -1, 0);
  joint.swing_a_rad = swing_a_rad;
  joint.swing_b_rad = swing_b_rad;
  joint.low = low_rad;
  joint.high = high_rad;
  joint.swing_center = from_rotation_vector(Vec3(0.3, -0.2, 0.5));
  return joint;
}

TEST(AimClamp, HoldsForNarrowWideAndFullRanges) {
  std::mt19937_64 random(6);
  const Joint balls[] = {ball(kPi, kPi, -kPi, kPi),  ball(1e-3, 2.0, -0.1, 0.1), ball(0.5, 0.5, 0.2, 0.2),
                         ball(3.0, 0.2, 2.9, kPi),   ball(1.0, 2.0, -6.0, 6.0),  ball(1e-7, 1e-7, -1e-10, 1e-10),
                         ball(2.0, 1.5, -kPi, -3.0), ball(kPi, 1.0, -3.1, 3.1)};
  for (const Joint& joint : balls)
    for (int i = 0; i < 3000; ++i) {
      double q[4];
      draw_any(joint, random, q);
      clamp_to_range(joint, q);
      const SwingTwist at = swing_twist_of(joint, q);
      const double ea = at.a_rad / joint.swing_a_rad;
      const double eb = at.b_rad / joint.swing_b_rad;
      EXPECT_LE(ea * ea + eb * eb, 1.0 + 1e-7);
      EXPECT_GE(at.twist_rad, std::max(joint.low, -kPi) - 1e-12);
      EXPECT_LE(at.twist_rad, std::min(joint.high, kPi) + 1e-12);
    }
}

TEST(AimClamp, SwingTwistRoundTrip) {
  std::mt19937_64 random(7);
  const Joint joint = ball(2.8, 2.5, -3.0, 3.0);
  for (int i = 0; i < 3000; ++i) {
    double q[4];
    fixtures::draw_joint(joint, random, q);
    double again[4];
    set_swing_twist(joint, swing_twist_of(joint, q), again);
    EXPECT_LT(
        rotation_angle(glm::conjugate(Quat(q[0], q[1], q[2], q[3])) * Quat(again[0], again[1], again[2], again[3])),
        1e-13);
  }
}

TEST(AimClamp, TwistGoesToTheEndThatIsNearerOnTheCircle) {
  const Joint joint = ball(1, 1, -110 * kRadPerDeg, 80 * kRadPerDeg);
  double q[4];
  set_swing_twist(joint, {0.1, 0.2, 179 * kRadPerDeg}, q);
  clamp_to_range(joint, q);
  EXPECT_NEAR(swing_twist_of(joint, q).twist_rad, -110 * kRadPerDeg, 2e-9);
  set_swing_twist(joint, {0.1, 0.2, 100 * kRadPerDeg}, q);
  clamp_to_range(joint, q);
  EXPECT_NEAR(swing_twist_of(joint, q).twist_rad, 80 * kRadPerDeg, 2e-9);
}

TEST(AimClamp, WhatIsNoNumberGoesToTheMiddle) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Joint joint = ball(1, 1, -1, 1);
  double q[4] = {nan, 0, 0, 0};
  clamp_to_range(joint, q);
  EXPECT_EQ(normalised_margin(joint, q), 1.0);
  Joint hinge;
  hinge.kind = JointKind::hinge;
  hinge.low = 1, hinge.high = 2;
  clamp_to_range(hinge, (q[0] = nan, q));
  EXPECT_EQ(q[0], 1.5);
}

}  // namespace
}  // namespace contort
