// A target between its frames: it passes through them, and its rates are its own derivatives.
#include "generator/dynamics/target.h"

#include <gtest/gtest.h>

#include <cmath>

#include "generator/dynamics/rotation_rates.h"
#include "generator/dynamics/tracker.h"
#include "generator/generate.h"
#include "tests/character/stock.h"
#include "tests/scenes.h"

namespace contort {
namespace {

Quat quat_of(const double* q) { return {q[0], q[1], q[2], q[3]}; }

struct Sample {
  Rigid root;
  std::vector<double> coords;
  std::vector<double> velocity;
};

Sample sampled(const Multibody& body, const TargetMotion& target, double frame) {
  Sample out;
  out.coords.resize(static_cast<std::size_t>(body.coord_count()));
  out.velocity.resize(static_cast<std::size_t>(body.dof_count()));
  target.root_at(frame, out.root, out.velocity.data());
  for (const Link& link : body.links().subspan(1))
    target.joint_at(link, frame, &out.coords[static_cast<std::size_t>(link.coord)],
                    &out.velocity[static_cast<std::size_t>(link.dof)]);
  return out;
}

// Velocity by central differences of poses.
std::vector<double> differences(const Multibody& body, const Sample& a, const Sample& b, double time_s) {
  std::vector<double> out(static_cast<std::size_t>(body.dof_count()));
  const auto put = [&](int dof, const Vec3& v) {
    for (int k = 0; k < 3; ++k) out[static_cast<std::size_t>(dof + k)] = v[k] / time_s;
  };
  put(0, b.root.p_m - a.root.p_m);
  put(3, to_rotation_vector(glm::conjugate(a.root.q) * b.root.q));
  for (const Link& link : body.links().subspan(1)) {
    const auto coord = static_cast<std::size_t>(link.coord);
    if (link.kind == JointKind::ball)
      put(link.dof, to_rotation_vector(glm::conjugate(quat_of(&a.coords[coord])) * quat_of(&b.coords[coord])));
    else
      out[static_cast<std::size_t>(link.dof)] = (b.coords[coord] - a.coords[coord]) / time_s;
  }
  return out;
}

TEST(Target, PassesThroughItsFramesAndItsRatesAreItsDerivatives) {
  for (const char* name : {"human_interrupted", "mech_walk_aim", "quadruped_slope"}) {
    const Result<Stage> stage = build_stage(scene(name), stock_library());
    ASSERT_TRUE(stage.ok());
    const Motion motion = generate(*stage);
    const Multibody body = Multibody::of(*stage->character);
    const TargetMotion target(body, motion);
    for (int f = 1; f < motion.frame_count - 1; f += 7) {
      const Sample there = sampled(body, target, f);
      for (std::size_t c = 0; c < there.coords.size(); ++c) EXPECT_NEAR(there.coords[c], motion.row(f)[c], 1e-12);
      EXPECT_LT(length(there.root.p_m - motion.root[static_cast<std::size_t>(f)].p_m), 1e-12);
      for (const double share : {0.0, 0.3, 0.9}) {
        constexpr double kStep = 1e-4;  // frames
        const Sample now = sampled(body, target, f + share);
        const auto slope = differences(body, sampled(body, target, f + share - kStep),
                                       sampled(body, target, f + share + kStep), 2 * kStep / motion.rate_hz);
        for (std::size_t i = 0; i < slope.size(); ++i)
          ASSERT_NEAR(now.velocity[i], slope[i], 2e-3 * (1.0 + std::fabs(slope[i])))
              << name << " " << f + share << " " << i;
      }
    }
  }
}

TEST(Target, StandsStillBeforeItsStartAndAfterItsEnd) {
  const Result<Stage> stage = build_stage(scene("human_reaches"), stock_library());
  const Motion motion = generate(*stage);
  const Multibody body = Multibody::of(*stage->character);
  const TargetMotion target(body, motion);
  for (const double frame : {-3.0, motion.frame_count + 5.0}) {
    const Sample there = sampled(body, target, frame);
    for (const double rate : there.velocity) EXPECT_EQ(rate, 0.0);
    const auto expected = motion.row(frame < 0 ? 0 : motion.frame_count - 1);
    for (std::size_t c = 0; c < there.coords.size(); ++c) EXPECT_NEAR(there.coords[c], expected[c], 1e-12);
  }
}

// A hinge at an even speed, and a root in free fall, go on so at both ends: no force starts or stops them there.
TEST(Target, GoesOnAtItsEndsAsItGoesBesideThem) {
  const Result<Stage> stage = build_stage(scene("human_reaches"), stock_library());
  const Character& character = *stage->character;
  Motion motion = generate(*stage);
  const Joint& elbow = character.joint(character.find_joint("arm_left/elbow"));
  for (int f = 0; f < motion.frame_count; ++f) {
    motion.row(f)[static_cast<std::size_t>(elbow.coord)] = 0.01 * f;
    motion.root[static_cast<std::size_t>(f)].p_m.y = 1.0 - 0.001 * f * f;
  }
  const Multibody body = Multibody::of(character);
  const TargetMotion target(body, motion);
  const auto link = static_cast<std::size_t>(character.find_joint("arm_left/elbow"));
  const auto dof = static_cast<std::size_t>(body.links()[link].dof);
  const double rate = motion.rate_hz, last = motion.frame_count - 1;
  for (const double frame : {0.0, last}) {
    const Sample there = sampled(body, target, frame);
    EXPECT_NEAR(there.velocity[dof], 0.01 * rate, 1e-9);
    EXPECT_NEAR(there.velocity[1], -0.002 * frame * rate, 1e-9);
    double fall[kRootDofs];
    target.root_acceleration_at(frame, fall);
    EXPECT_NEAR(fall[1], -0.002 * rate * rate, 1e-6);
  }
}

// A figure starts at its target's rates: a first tick that asked for the rates of a target at rest would jolt it.
TEST(Track, AFigureThatStartsInTheMiddleOfAMotionIsNotJoltedByItsFirstTick) {
  const Result<Stage> stage = build_stage(scene("human_reaches"), stock_library());
  const Character& character = *stage->character;
  Motion motion = generate(*stage);
  const Joint& elbow = character.joint(character.find_joint("arm_left/elbow"));
  for (int f = 0; f < motion.frame_count; ++f) motion.row(f)[static_cast<std::size_t>(elbow.coord)] = 0.01 * f;
  const Multibody body = Multibody::of(character);
  const TargetMotion target(body, motion);
  const FigureState state = moving_start(body, target, 1.0 / 120.0);
  std::vector<double> acceleration(state.velocity.size());
  TrackScratch scratch;
  track(body, target, 0.0, 1.0 / 120.0, {false, true}, state, scratch, acceleration);
  const auto link = static_cast<std::size_t>(character.find_joint("arm_left/elbow"));
  EXPECT_NEAR(acceleration[static_cast<std::size_t>(body.links()[link].dof)], 0.0, 1e-6);
}

// Eight frames for a turn are as fast as actions turn joints. Errors of a tenth of a degree in
// each of four joints would be an aim that misses.
TEST(Track, AFigureThatTakesTheTargetsAccelerationsInTicksArrivesWithIt) {
  const Result<Stage> stage = build_stage(scene("quadruped_slope"), stock_library());
  const Character& character = *stage->character;
  Motion motion = generate(*stage);
  const Joint& tail = character.joint(character.find_joint("tail/tail_2"));
  const Joint& neck = character.joint(character.find_joint("head/neck_lat"));
  for (int f = 0; f < motion.frame_count; ++f) {
    const double angle = 0.4 * minimum_jerk(std::clamp((f - 3) / 8.0, 0.0, 1.0));
    double* q = &motion.row(f)[static_cast<std::size_t>(tail.coord)];
    q[0] = det::cos(0.5 * angle), q[1] = det::sin(0.5 * angle), q[2] = q[3] = 0.0;
    motion.row(f)[static_cast<std::size_t>(neck.coord)] = angle;
  }
  const Multibody body = Multibody::of(character);
  const TargetMotion target(body, motion);
  for (const int ticks : {1, 2, 4}) {
    const double tick_s = 1.0 / (ticks * motion.rate_hz);
    FigureState state = moving_start(body, target, tick_s);
    std::vector<double> acceleration(state.velocity.size());
    TrackScratch scratch;
    for (int i = 0; i < 12 * ticks; ++i) {
      track(body, target, static_cast<double>(i) / ticks, tick_s, {true, true}, state, scratch, acceleration);
      advance(body, acceleration, tick_s, state);
    }
    EXPECT_NEAR(state.coords[static_cast<std::size_t>(neck.coord)], 0.4, 0.015 * kRadPerDeg) << ticks;
    const double turned = 2.0 * det::acos(state.coords[static_cast<std::size_t>(tail.coord)]);
    EXPECT_NEAR(turned, 0.4, 0.015 * kRadPerDeg) << ticks;
  }
}

TEST(Target, LegsOfOneChainShareTheirKnots) {
  const Result<Stage> stage = build_stage(scene("mech_walk_aim"), stock_library());
  const Motion motion = generate(*stage);
  const Multibody body = Multibody::of(*stage->character);
  TargetMotion target(body, motion);
  const int left = stage->character->find_joint("leg_left/knee"),
            right = stage->character->find_joint("leg_right/knee");
  EXPECT_NE(target.knots(left), target.knots(right));
  const std::vector<int> both = merged_knots(target.knots(left), target.knots(right));
  target.share_knots({left, right});
  EXPECT_EQ(target.knots(left), both);
  EXPECT_EQ(target.knots(right), both);
  EXPECT_EQ(both.back(), motion.frame_count - 1);
}

TEST(RotationRates, UndoEachOtherAndAreDerivatives) {
  for (const Vec3& rotation : {Vec3(0.0), Vec3(1e-5, 0.0, 2e-5), Vec3(9e-4, 1e-4, 0.0), Vec3(1.2e-3, 0.0, 0.0),
                               Vec3(0.3, -1.0, 2.0), Vec3(0, 3.1, 0)}) {
    const Vec3 rate(0.7, -0.2, 0.4);
    const Vec3 angular = angular_velocity_of(rotation, rate);
    EXPECT_LT(length(rotation_vector_rate(rotation, angular) - rate), 1e-9);
    constexpr double kStep = 1e-6;
    const Quat before = from_rotation_vector(rotation - kStep * rate),
               after = from_rotation_vector(rotation + kStep * rate);
    EXPECT_LT(length(to_rotation_vector(glm::conjugate(before) * after) / (2 * kStep) - angular), 1e-8);
  }
}

}  // namespace
}  // namespace contort
