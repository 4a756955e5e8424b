// Pushes on whole figures: which make them fall or fly, and how they fall.
#include <gtest/gtest.h>

#include <cmath>

#include "generator/generate.h"
#include "model/core/detmath.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

constexpr int kPushed = 10;

Motion pushed(const std::string& name, double impulse_N_s, double heading_deg, int frames = 240) {
  Spec spec;
  spec.character.name = name;
  spec.hold_frames = frames;
  spec.dynamics.mode = Mode::dynamic;
  const det::SinCos way = det::sincos(heading_deg * kRadPerDeg);
  spec.dynamics.impacts = {{kPushed, "torso", "", Vec3(0.0), impulse_N_s * Vec3(way.sin, 0.0, way.cos)}};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return generate(*stage);
}

bool falls(const Motion& motion) { return motion.response.stances.back().footing == Footing::fallen; }

double root_speed_m_s(const Motion& motion, int frame) {
  const auto f = static_cast<std::size_t>(frame);
  return length(motion.root[f + 1].p_m - motion.root[f].p_m) * motion.rate_hz;
}

// The hardest push that it withstands, to 1 N s.
double withstood_N_s(const std::string& name, double heading_deg) {
  double low = 0.0, high = 1024.0;
  while (high - low > 1.0) {
    const double middle = 0.5 * (low + high);
    (falls(pushed(name, middle, heading_deg)) ? high : low) = middle;
  }
  return low;
}

// A capture point may go as far as the soles reach. For 73 kg with the centre of mass 1 m high, .13 m to the side and
// .06 m to the heels: 0.42 and 0.19 N s/kg.
TEST(Pushes, WhatAStandingHumanWithstandsFollowsFromItsSoles) {
  const double mass_kg = 73.0;
  const double forward = withstood_N_s("human", 0.0), backward = withstood_N_s("human", 180.0);
  const double left = withstood_N_s("human", 90.0), right = withstood_N_s("human", 270.0);
  EXPECT_NEAR(left / mass_kg, 0.42, 0.1);
  EXPECT_NEAR(right, left, 1.0);
  EXPECT_NEAR(backward / mass_kg, 0.19, 0.05);
  EXPECT_GT(forward / mass_kg, 0.45);
  EXPECT_LT(forward / mass_kg, 0.9);
}

// The trunk comes near to an arm of a runner that was pushed, and stops it on its way. The arm was still off by 7
// degrees 0.7 s after the push.
TEST(Pushes, AnArmThatTheTrunkHasStoppedComesBackInTime) {
  Spec spec;
  spec.character.name = "mech";
  spec.dynamics.mode = Mode::dynamic;
  spec.dynamics.impacts = {{0, "torso", "", Vec3(0.0), Vec3(0.0, 0.0, -55.0)}};
  spec.sequences = {fixtures::sequence({fixtures::use("run", "waist", 0, 56, {})})};
  for (const int frame : {0, 20, 53}) {
    spec.dynamics.impacts[0].frame = frame;
    EXPECT_EQ(broken_in(*build_stage(spec, stock_library())), "") << frame;
  }
}

// The elbow of a standing paw comes to its end. It stops there, and the leg's other joints bend instead.
TEST(Pushes, AStandingLegWithSpareJointsWithstandsAnImpactOnIt) {
  Spec spec;
  spec.character.name = "quadruped";
  spec.dynamics.mode = Mode::dynamic;
  spec.hold_frames = 70;
  for (const bool laden : {false, true}) {
    if (laden) spec.character.attachments = {{"backpack", "trunk", "back"}};
    for (const char* slot : {"leg_fore_left", "leg_fore_right", "leg_hind_left", "leg_hind_right"})
      for (int k = 0; k < 8; ++k) {
        const det::SinCos way = det::sincos(k * kPi / 4.0);
        const Vec3 impulse_N_s(9.0 * way.cos, 4.0, 9.0 * way.sin);
        spec.dynamics.impacts = {{10, slot, "", Vec3(0.0), impulse_N_s}};
        EXPECT_EQ(broken_in(*build_stage(spec, stock_library())), "") << slot << " " << k << " " << laden;
      }
  }
}

// After the stop, the accelerations that joints want would drive the elbow on by 9 rad/s within two ticks.
TEST(Pushes, AHingeAtItsEndStaysThereWhileItIsPushedOutward) {
  Spec spec;
  spec.character.name = "quadruped";
  spec.character.attachments = {{"backpack", "trunk", "back"}};
  spec.dynamics.mode = Mode::dynamic;
  spec.dynamics.impacts = {{10, "leg_fore_left", "", Vec3(0.0), Vec3(5.0, 9.0, 5.5)}};
  spec.hold_frames = 70;
  EXPECT_EQ(broken_in(*build_stage(spec, stock_library())), "");
}

// A joint that cannot hold the load is told also after a touch that moves the figure by 7 mm/s.
TEST(Pushes, AWeakBlowHidesNoOverload) {
  Spec spec;
  spec.character.name = "mech";
  spec.dynamics.mode = Mode::dynamic;
  spec.dynamics.loads = {LoadDesc{.slot = "head", .socket = "face", .mass_kg = 105.0}};
  spec.hold_frames = 30;
  EXPECT_NE(broken_in(*build_stage(spec, stock_library())).find("joint_torque"), std::string::npos);
  spec.dynamics.impacts = {{0, "torso", "", Vec3(0.0), Vec3(0.0, 0.0, 3.0)}};
  EXPECT_NE(broken_in(*build_stage(spec, stock_library())).find("joint_torque"), std::string::npos);
}

TEST(Pushes, AHeavierFigureOnLargerSolesWithstandsMore) {
  EXPECT_GT(withstood_N_s("mech", 90.0), 5.0 * withstood_N_s("human", 90.0));
}

TEST(Pushes, TheFasterTheRootGoesTheHarderItWasPushed) {
  double before_m_s = 0.0;
  for (const double push_N_s : {8.0, 30.0, 100.0, 300.0, 1000.0}) {
    const double speed_m_s = root_speed_m_s(pushed("human", push_N_s, 90.0), kPushed);
    EXPECT_GT(speed_m_s, 1.2 * before_m_s) << push_N_s;
    before_m_s = speed_m_s;
  }
  EXPECT_GT(before_m_s, 10.0) << "1,000 N s throw 73 kg";
}

TEST(Pushes, AFigureThatFallsKeepsWithinItsStrengthAndBelowWhereItStood) {
  Spec spec;
  spec.character.name = "human";
  spec.dynamics.mode = Mode::dynamic;
  const Stage stage = *build_stage(spec, stock_library());
  const DynamicFigure& figure = stage.dynamics->figure;
  for (const double heading_deg : {0.0, 45.0, 90.0, 180.0}) {
    const Motion motion = pushed("human", 90.0, heading_deg, 420);
    ASSERT_TRUE(falls(motion)) << heading_deg;
    const auto n = static_cast<std::size_t>(motion.response.dof_count);
    for (std::size_t i = 0; i < motion.response.efforts.size(); ++i) {
      EXPECT_LE(motion.response.efforts[i], figure.strength_high[i % n] * 1.001 + 1e-6) << heading_deg << " " << i / n;
      EXPECT_GE(motion.response.efforts[i], figure.strength_low[i % n] * 1.001 - 1e-6) << heading_deg << " " << i / n;
    }
    for (const Rigid& root : motion.root) {
      EXPECT_LT(root.p_m.y, motion.root[0].p_m.y + 0.05) << heading_deg;
      EXPECT_GT(root.p_m.y, 0.0) << heading_deg;
    }
    EXPECT_LT(motion.root.back().p_m.y, 0.4) << heading_deg << ": it lies";
    EXPECT_LT(root_speed_m_s(motion, motion.frame_count - 2), 0.05) << heading_deg << ": it has come to rest";
  }
}

}  // namespace
}  // namespace contort
