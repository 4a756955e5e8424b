// Standing, crouching and squatting: where hips and feet are, measured on the motion.
#include <gtest/gtest.h>

#include <cmath>

#include "generator/execute.h"
#include "model/core/detmath.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

struct Stood {
  Motion motion;
  std::shared_ptr<const Character> character;

  Rigid root(int frame) const { return motion.root[static_cast<std::size_t>(frame)]; }
  double knee_deg(int frame) const { return fixtures::coord(motion, frame, *character, "leg_left/knee") * kDegPerRad; }
  double ankle_rad(int frame) const { return fixtures::coord(motion, frame, *character, "foot_left/ankle_flex"); }
  Rigid sole(int frame) const {
    std::vector<Rigid> world(character->joints().size());
    forward_kinematics(*character, root(frame), motion.row(frame), world);
    return world_from_socket(*character, world, character->find_socket("foot_left/sole"));
  }
};

Stood stood(const StartDesc& start, std::vector<ActionUse> actions) {
  Spec spec;
  spec.start = start;
  spec.sequences = {sequence(std::move(actions))};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return {generate(*stage), stage->character};
}

ActionUse squat(double lean_deg, double back_m, double share = 0.3) {
  return use("squat", "waist", 0, 90, {{"share", share}, {"lean_deg", lean_deg}, {"back_m", back_m}});
}

TEST(Stand, ASquatBendsTheKneesLikeACosine) {
  const Stood at = stood({}, {squat(0.0, 0.0, 0.15)});
  const double lowest_deg = 2.0 * std::acos(1.0 - 0.15) * kDegPerRad;  // two nearly equal bones
  EXPECT_NEAR(at.knee_deg(45), lowest_deg, 1.0);
  for (int f = 5; f < 90; f += 5)
    EXPECT_NEAR(at.knee_deg(f), lowest_deg * (0.5 - 0.5 * std::cos(2.0 * kPi * f / 90.0)), 1.0) << f;
}

TEST(Stand, ASquatLeansAndSitsBackWhileTheFeetStay) {
  const Stood at = stood({}, {squat(40.0, 0.2)});
  const Vec3 up = at.root(45).q * Vec3(0, 1, 0);
  EXPECT_NEAR(up.z, std::sin(40.0 * kRadPerDeg), 1e-9);
  EXPECT_NEAR(at.root(45).p_m.z - at.root(0).p_m.z, -0.2, 1e-9);
  for (int f = 0; f <= 90; ++f) {
    EXPECT_LT(length(at.sole(f).p_m - at.sole(0).p_m), 1e-6) << f;
    EXPECT_NEAR((at.sole(f).q * Vec3(0, 1, 0)).y, 1.0, 1e-9) << f;
  }
}

// With hips above the feet an ankle does not bend as far as a deep squat asks.
TEST(Stand, HeelsRiseInADeepSquatAndToesStay) {
  const Stood at = stood({}, {squat(0.0, 0.0, 0.45)});
  const Leg leg = find_legs(*at.character).front();
  const Vec3 toes(0.0, 0.0, leg.high_m.z), heel(0.0, 0.0, leg.low_m.z);
  EXPECT_GT((at.sole(45) * heel).y, 0.05);
  for (int f = 0; f <= 90; ++f) {
    EXPECT_LT(length(at.sole(f) * toes - at.sole(0) * toes), 1e-6) << f;
    EXPECT_LE(at.ankle_rad(f), fixtures::joint(*at.character, "foot_left/ankle_flex").high + 1e-9) << f;
  }
  EXPECT_NEAR(at.root(0).p_m.y - at.root(45).p_m.y, 0.45 * leg.length_m, 1e-3) << "as deep as it was asked for";
}

// Deeper than the knee bends, and faster than it turns.
TEST(Stand, ASquatThatJointsDoNotAllowIsAsDeepAsTheyDoAndUnmet) {
  for (const int frames : {90, 12}) {
    Spec spec;
    spec.sequences = {sequence({use("squat", "waist", 0, frames, {{"share", 0.6}})})};
    const Result<Stage> stage = build_stage(spec, stock_library());
    ASSERT_TRUE(stage);
    const Intent intent = intent_of(*stage);
    ASSERT_EQ(intent.unmet.size(), 1U) << frames;
    EXPECT_EQ(intent.unmet[0].why, Shortfall::joint_range) << frames;
    const Motion motion = generate(*stage);
    const double down_m = motion.root[0].p_m.y - motion.root[at(frames / 2)].p_m.y;
    EXPECT_GT(down_m, frames == 90 ? 0.4 : 0.03);
    EXPECT_LT(down_m, 0.55);
  }
}

TEST(Stand, HipsStandAheadOfTheFeetAndLowerFromTheFirstFrameOn) {
  const std::vector<ActionUse> shallow{squat(0.0, 0.0, 0.05)};
  const Stood plain = stood({}, shallow), changed = stood({{}, 30.0, 0.05, 0.02}, shallow);
  const Vec3 forward(std::sin(30.0 * kRadPerDeg), 0.0, std::cos(30.0 * kRadPerDeg));
  const Vec3 left(forward.z, 0.0, -forward.x);
  for (const int f : {0, 45, 90}) {
    const Vec3 way = changed.root(f).p_m - changed.sole(f).p_m, before = plain.root(f).p_m - plain.sole(f).p_m;
    EXPECT_NEAR(glm::dot(way, forward), before.z + 0.05, 1e-6) << f;
    EXPECT_NEAR(glm::dot(way, left), before.x, 1e-6) << f;
    EXPECT_NEAR(changed.sole(f).p_m.y, 0.0, 1e-6) << f;
    EXPECT_LT(changed.root(f).p_m.y, plain.root(f).p_m.y - 0.015) << f;
  }
}

}  // namespace
}  // namespace contort
