// Joints follow their wanted angles: at once if they can, otherwise within their speeds, and without overshooting.
#include "generator/motion/joint_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/character/stock.h"

namespace contort {
namespace {

constexpr double kRate_hz = 60.0;

struct Elbow {
  explicit Elbow(std::span<const double> easy = {})
      : coords(fixtures::human().rest_coords().begin(), fixtures::human().rest_coords().end()) {
    path.begin(fixtures::human(), coords, kRate_hz, easy);
  }
  // The angle that the elbow reaches in the next frame, rad; `behind` if that is not where it is wanted.
  double follow(double wanted_rad) {
    coords[at()] = wanted_rad;
    behind = path.follow(part, coords);
    return coords[at()];
  }
  std::size_t at() const { return static_cast<std::size_t>(joint.coord); }

  const Joint& joint = fixtures::joint(fixtures::human(), "arm_left/elbow");
  std::size_t part = static_cast<std::size_t>(fixtures::human().find_part("arm_left"));
  std::vector<double> coords;
  JointPath path;
  bool behind = false;
};

TEST(JointPath, WhatCanBeHadAtOnceIsPassedOnBitByBit) {
  Elbow elbow;
  for (int f = 1; f <= 60; ++f) {
    const double wanted_rad = 0.5 - 0.5 * std::cos(0.05 * f);
    EXPECT_EQ(elbow.follow(wanted_rad), wanted_rad) << f;
    EXPECT_FALSE(elbow.behind) << f;
  }
}

TEST(JointPath, AJumpIsFollowedWithinAnEasyAccelerationAndNotBeyond) {
  constexpr double kEasy_rad_s2 = 7.0;
  const std::vector<double> easy(fixtures::human().joints().size(), kEasy_rad_s2);
  Elbow elbow(easy);
  double before = 0.0, step_before = 0.0;
  for (int f = 1; f <= 120; ++f) {
    const double now = elbow.follow(2.0), step = now - before;
    EXPECT_LE(now, 2.0 + 1e-12) << f;
    EXPECT_LE(std::fabs(step - step_before) * kRate_hz * kRate_hz, kEasy_rad_s2 + 1e-9) << f;
    before = now, step_before = step;
  }
  EXPECT_EQ(before, 2.0);
}

// With the easy acceleration alone it would need 4 rad to lose this speed.
TEST(JointPath, AJointThatWasMovedOutOfTheWayDoesNotCoastOn) {
  constexpr double kEasy_rad_s2 = 7.0, kStep_rad = 0.13;
  const std::vector<double> easy(fixtures::human().joints().size(), kEasy_rad_s2);
  Elbow elbow(easy);
  const std::vector<double> before = elbow.coords;
  elbow.coords[elbow.at()] = kStep_rad;
  elbow.path.correct(elbow.part, before, elbow.coords);
  double farthest = 0.0;
  for (int f = 1; f <= 60; ++f) farthest = std::max(farthest, elbow.follow(kStep_rad));
  EXPECT_GT(farthest, kStep_rad);
  EXPECT_LT(farthest, 1.0);
}

TEST(JointPath, AJumpIsFollowedWithinSpeedAndAccelerationAndNotBeyond) {
  Elbow elbow;
  const double most = elbow.joint.max_speed / kRate_hz;
  double before = 0.0, step_before = 0.0;
  int arrived = 0;
  for (int f = 1; f <= 60; ++f) {
    const double now = elbow.follow(2.0), step = now - before;
    EXPECT_LE(step, most) << f;
    EXPECT_GE(step, -1e-12) << "never back, frame " << f;
    EXPECT_LE(std::fabs(step - step_before), most * (1.0 / kRate_hz) / 0.1 + 1e-12) << f;
    before = now, step_before = step;
    if (arrived == 0 && !elbow.behind) arrived = f;
  }
  EXPECT_EQ(before, 2.0);
  EXPECT_GT(arrived, 2.0 / most) << "the time at the greatest speed";
  EXPECT_LT(arrived, 2.0 / most + 10.0) << "and a tenth of a second to gather speed and to lose it";
}

// The wanted posture races to the end of the range and stops there at once.
TEST(JointPath, AJointThatCatchesUpStaysInItsRange) {
  Elbow elbow;
  double greatest = 0.0;
  for (int f = 1; f <= 60; ++f) greatest = std::max(greatest, elbow.follow(std::min(elbow.joint.high, 0.4 * f)));
  EXPECT_LE(greatest, elbow.joint.high);
  EXPECT_EQ(elbow.coords[elbow.at()], elbow.joint.high);
}

TEST(JointPath, AfterACutTheJointIsAtRestWhereItWasPut) {
  Elbow elbow;
  elbow.coords[elbow.at()] = 1.5;
  elbow.path.cut(elbow.part, elbow.coords);
  EXPECT_EQ(elbow.follow(1.5), 1.5);
  EXPECT_EQ(elbow.follow(1.51), 1.51);
}

TEST(JointPath, NaNIsPassedOnAndForgotten) {
  Elbow elbow;
  EXPECT_TRUE(std::isnan(elbow.follow(std::nan(""))));
  elbow.follow(0.2);
  EXPECT_EQ(elbow.follow(0.2), 0.2);
}

}  // namespace
}  // namespace contort
