// Accelerations that joints of a figure with mass may have at ease.
#include "generator/dynamics/easy_acceleration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "generator/dynamics/dynamics.h"
#include "generator/generate.h"
#include "generator/motion/way.h"
#include "model/motion/legs.h"
#include "tests/character/stock.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

struct Resting {
  explicit Resting(const Character& of) : character(of) {
    place(figure.body, character.rest_root(), character.rest_coords(), scratch);
    forces.assign(zeros().size(), 0.0);
  }
  std::vector<double> zeros() const { return std::vector<double>(static_cast<std::size_t>(figure.body.dof_count())); }

  // The forces for an acceleration of one degree of freedom without gravity, by inverse dynamics, which is independent
  // of the mass matrix.
  void accelerate(int dof, double acceleration) {
    std::vector<double> accelerations = zeros();
    accelerations[static_cast<std::size_t>(dof)] = acceleration;
    inverse_dynamics(figure.body, zeros(), accelerations, 0.0, scratch, forces);
  }
  // Returns the distance by which they move the zero moment point on the ground below an upright root, m.
  double zmp_shift_m() const {
    const double height_m = scratch.world[0].origin_m.y;
    const double x = forces[5] - height_m * forces[0], z = forces[3] + height_m * forces[2];
    return std::hypot(x, z) / (figure.body.mass_kg() * kGravity_m_s2);
  }

  const Character& character;
  const std::vector<Leg> legs = find_legs(character);
  const DynamicFigure figure = build_figure(character, legs, {});
  DynamicsScratch scratch;
  std::vector<double> forces;
};

TEST(EasyAcceleration, TakesAFifthOfAJointsStrengthAtMost) {
  for (const char* name : {"human", "mech", "quadruped"}) {
    CharacterChoice choice;
    choice.name = name;
    const Character character = fixtures::built(choice);
    Resting resting(character);
    const std::vector<double> easy = easy_accelerations(resting.character, resting.figure);
    for (std::size_t i = 1; i < easy.size(); ++i) {
      const Link& link = resting.figure.body.links()[i];
      ASSERT_GT(easy[i], 0.0) << name << ' ' << resting.character.joints()[i].name;
      for (int dof = link.dof; dof < link.dof + link.dof_count; ++dof) {
        if (!std::isfinite(easy[i])) continue;
        resting.accelerate(dof, easy[i]);
        EXPECT_LE(resting.forces[static_cast<std::size_t>(dof)],
                  0.2 * resting.figure.strength_high[static_cast<std::size_t>(dof)] * (1.0 + 1e-9))
            << name << ' ' << resting.character.joints()[i].name;
      }
    }
  }
}

// A hip that lifts a leg of `mech`, which has 40 kg, turns the hips about the other one.
TEST(EasyAcceleration, ALegThatMovesLeavesTheOneThatStandsMostOfItsStrength) {
  CharacterChoice choice;
  choice.name = "mech";
  const Character mech = fixtures::built(choice);
  Resting resting(mech);
  const std::vector<double> easy = easy_accelerations(mech, resting.figure);
  const auto link = static_cast<std::size_t>(mech.find_joint("leg_left/hip_flex"));
  const auto other = static_cast<std::size_t>(mech.find_joint("leg_right/hip_rot"));
  const auto dof = static_cast<std::size_t>(resting.figure.body.links()[other].dof);
  resting.accelerate(resting.figure.body.links()[link].dof, easy[link]);
  const SpatialMotion& freedom = resting.scratch.freedoms[dof];
  double effort = 0.0;
  for (int k = 0; k < 3; ++k)
    effort += freedom.linear[k] * resting.forces[static_cast<std::size_t>(k)] +
              freedom.angular[k] * resting.forces[static_cast<std::size_t>(3 + k)];
  EXPECT_GT(std::fabs(effort), 0.0);
  EXPECT_LE(std::fabs(effort), 0.2 * resting.figure.strength_high[dof] * (1.0 + 1e-9));
}

// The feet of `human` reach 5 cm behind its centre of mass and farther ahead.
TEST(EasyAcceleration, MovesTheZeroMomentPointByAFifthOfTheWayToTheHeelsAtMost) {
  Resting resting(fixtures::human());
  const std::vector<double> easy = easy_accelerations(resting.character, resting.figure);
  const Joint& shoulder = fixtures::joint(resting.character, "arm_left/shoulder");
  const int index = resting.character.find_joint("arm_left/shoulder");
  const Link& link = resting.figure.body.links()[static_cast<std::size_t>(index)];
  ASSERT_EQ(shoulder.kind, JointKind::ball);
  for (int dof = link.dof; dof < link.dof + link.dof_count; ++dof) {
    resting.accelerate(dof, easy[static_cast<std::size_t>(index)]);
    EXPECT_LT(resting.zmp_shift_m(), 0.2 * 0.1);
  }
}

TEST(EasyAcceleration, AHeavyThingInTheHandMakesTheArmSlower) {
  const Character& human = fixtures::human();
  const std::vector<Leg> legs = find_legs(human);
  const int hand = human.find_joint("hand_left/wrist_flex");
  const Load load = box_load(hand, {kNoRotation, Vec3(0.0, -0.1, 0.0)}, Vec3(0.2), 5.0);
  const std::vector<double> free = easy_accelerations(human, build_figure(human, legs, {}));
  const std::vector<double> laden = easy_accelerations(human, build_figure(human, legs, std::span(&load, 1)));
  const auto shoulder = static_cast<std::size_t>(human.find_joint("arm_left/shoulder"));
  EXPECT_LT(laden[shoulder], 0.7 * free[shoulder]);
  EXPECT_LT(laden[static_cast<std::size_t>(hand)], 0.2 * free[static_cast<std::size_t>(hand)]);
}

// A minimum-jerk blend accelerates by 10 / sqrt(3) of its way over the square of its time.
TEST(EasyAcceleration, BlendsTakeTheTimeThatItNeeds) {
  const Character& human = fixtures::human();
  Posture from, to;
  from.coords.assign(human.rest_coords().begin(), human.rest_coords().end());
  to = from;
  const auto elbow = static_cast<std::size_t>(human.find_joint("arm_left/elbow"));
  to.coords[static_cast<std::size_t>(human.joints()[elbow].coord)] += 1.5;
  std::vector<double> easy(human.joints().size(), 3.0);
  const auto part = static_cast<std::size_t>(human.find_part("arm_left"));
  EXPECT_NEAR(way_s(human, part, from, to, easy), std::sqrt(10.0 / std::sqrt(3.0) * 1.5 / 3.0), 1e-3);
  easy[elbow] = 1e9;
  EXPECT_EQ(way_s(human, part, from, to, easy), way_s(human, part, from, to)) << "as its speed allows";
}

// Without the limit, raising a rifle needed up to seven times the strength of the wrist.
TEST(EasyAcceleration, ARifleIsRaisedWithinTheStrengthOfTheWrist) {
  Spec spec;
  spec.character.name = "human";
  spec.character.attachments.push_back({"rifle", "hand_right", "grip"});
  ActionUse aim = use("aim", "arm_right", 0, 90, {{"target_m", Vec3(-0.5, 1.3, 3.0)}, {"point", "muzzle"}});
  aim.blend_in_frames = -1;  // the default: as long as the distance needs
  spec.sequences = {sequence({aim})};
  spec.dynamics.mode = Mode::tracking;
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  const Motion motion = generate(*stage);
  const DynamicFigure& figure = stage->dynamics->figure;
  const int wrist = stage->character->find_joint("hand_right/wrist_flex");
  const auto dof = static_cast<std::size_t>(figure.body.links()[static_cast<std::size_t>(wrist)].dof);
  const Response& response = motion.response;
  for (int f = 0; f < motion.frame_count; ++f) {
    const double effort = response.efforts[static_cast<std::size_t>(f * response.dof_count) + dof];
    EXPECT_LE(effort, figure.strength_high[dof]) << f;
    EXPECT_GE(effort, figure.strength_low[dof]) << f;
  }
}

}  // namespace
}  // namespace contort
