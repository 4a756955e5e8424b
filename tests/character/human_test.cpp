// The stock human against the tables that it was made from: de Leva 1996, male, 73 kg, 1.741 m.
#include <gtest/gtest.h>

#include <cmath>

#include "model/motion/kinematics.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

using fixtures::human;
using fixtures::joint;

int degrees_of_freedom(const Character& character) {
  int count = 6;  // the root's
  for (const Joint& j : character.joints()) count += j.kind == JointKind::ball ? 3 : coord_size(j.kind);
  return count;
}

std::vector<Rigid> human_world_at_rest(const Character& character) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  return world;
}

struct Body73 {
  double mass_kg = 0.0;
  Vec3 center_m{0.0};
};

Body73 whole_body(const Character& character) {
  const std::vector<Rigid> world = human_world_at_rest(character);
  Body73 body;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Joint& j = character.joints()[i];
    body.mass_kg += j.mass_kg;
    body.center_m += j.mass_kg * (world[i] * j.center_of_mass_m);
  }
  body.center_m /= body.mass_kg;
  return body;
}

TEST(Human, Has36DegreesOfFreedomInElevenParts) {
  EXPECT_EQ(degrees_of_freedom(human()), 36);
  EXPECT_EQ(human().parts().size(), 11U);
  EXPECT_EQ(human().coord_count(), 24 + 2 * 4);  // 24 hinges, two shoulders
}

TEST(Human, OnlyTheShouldersAreBalls) {
  for (const Joint& j : human().joints()) EXPECT_EQ(j.kind == JointKind::ball, j.local_name == "shoulder") << j.name;
  EXPECT_EQ(joint(human(), "arm_left/shoulder").kind, JointKind::ball);
  EXPECT_EQ(joint(human(), "arm_right/shoulder").kind, JointKind::ball);
}

// The table's fractions are rounded to a gram per segment: 73.000 to 1 g.
TEST(Human, Weighs73Kilograms) { EXPECT_NEAR(whole_body(human()).mass_kg, 73.0, 0.003); }

// The table's frame has x forward, y left, z up: (0.0018, 0, 1.0036) there is (0, 1.0036, 0.0018) here.
TEST(Human, BalancesOneMetreAboveTheGround) {
  const Vec3 center_m = whole_body(human()).center_m;
  EXPECT_NEAR(center_m.x, 0.0, 1e-12);
  EXPECT_NEAR(center_m.y, 1.0036, 1e-4);
  EXPECT_NEAR(center_m.z, 0.0018, 1e-4);
}

TEST(Human, JointsAreWhereTheTablePutsThem) {
  struct Place {
    const char* joint;
    Vec3 from_root_m;
  };
  const double neck = 0.1457 + 0.4576;
  const double shoulder = 0.1457 + 0.3698;
  const Place places[] = {
      {"torso/lumbar_flex", {0, 0.1457, 0}},
      {"head/neck_flex", {0, neck, 0}},
      {"arm_left/shoulder", {0.209, shoulder, 0}},
      {"arm_right/shoulder", {-0.209, shoulder, 0}},
      {"arm_left/elbow", {0.209, shoulder - 0.2817, 0}},
      {"hand_left/wrist_flex", {0.209, shoulder - 0.2817 - 0.2689, 0}},
      {"hand_right/wrist_flex", {-0.209, shoulder - 0.2817 - 0.2689, 0}},
      {"leg_left/hip_flex", {0.081, 0, 0}},
      {"leg_right/knee", {-0.081, -0.4222, 0}},
      {"foot_left/ankle_flex", {0.081, -0.4222 - 0.4403, 0}},
  };
  const std::vector<Rigid> world = human_world_at_rest(human());
  const Vec3 root_m = human().rest_root().p_m;
  EXPECT_NEAR(root_m.y, 0.9325, 1e-9);
  for (const Place& place : places) {
    const int index = human().find_joint(place.joint);
    ASSERT_GE(index, 0) << place.joint;
    EXPECT_LT(length(world[static_cast<std::size_t>(index)].p_m - root_m - place.from_root_m), 1e-12) << place.joint;
  }
}

// Moments (Ixx, Iyy, Izz) there are (Iyy, Izz, Ixx) here.
TEST(Human, SegmentsHaveTheTablesInertia) {
  struct Segment {
    const char* joint;
    double mass_kg;
    Vec3 table_kg_m2;
  };
  const Segment segments[] = {
      {"root", 8.154, {.06547, .05255, .05964}},
      {"torso/lumbar_rot", 23.572, {.57887, .42724, .26891}},
      {"head/neck_rot", 5.066, {.02744, .02966, .02036}},
      {"arm_left/shoulder", 1.978, {.01275, .01136, .00392}},
      {"arm_right/elbow", 1.183, {.00651, .00600, .00125}},
      {"hand_left/wrist_dev", 0.445, {.00130, .00087, .00053}},
      {"leg_right/hip_rot", 10.337, {.19944, .19944, .04091}},
      {"leg_left/knee", 3.161, {.03861, .03708, .00638}},
      {"foot_left/ankle_inv", 1.000, {.00102, .00400, .00440}},
  };
  for (const Segment& s : segments) {
    const Joint& j = joint(human(), s.joint);
    EXPECT_NEAR(j.mass_kg, s.mass_kg, 1e-12) << s.joint;
    EXPECT_NEAR(j.inertia_kg_m2[0][0], s.table_kg_m2.y, 1e-9) << s.joint;
    EXPECT_NEAR(j.inertia_kg_m2[1][1], s.table_kg_m2.z, 1e-9) << s.joint;
    EXPECT_NEAR(j.inertia_kg_m2[2][2], s.table_kg_m2.x, 1e-9) << s.joint;
  }
}

// Flexing moves the distal link forward (+Z) or, at the knee, backward; abducting moves it outward.
TEST(Human, PositiveAnglesTurnTheWayTheirNamesSay) {
  struct Turn {
    const char* joint;
    const char* watched;
    Vec3 direction;
  };
  const Turn turns[] = {
      {"arm_left/elbow", "hand_left/wrist_flex", {0, 0, 1}}, {"arm_right/elbow", "hand_right/wrist_flex", {0, 0, 1}},
      {"leg_left/hip_flex", "leg_left/knee", {0, 0, 1}},     {"leg_right/hip_flex", "leg_right/knee", {0, 0, 1}},
      {"leg_left/hip_abd", "leg_left/knee", {1, 0, 0}},      {"leg_right/hip_abd", "leg_right/knee", {-1, 0, 0}},
      {"leg_left/knee", "foot_left/ankle_flex", {0, 0, -1}}, {"leg_right/knee", "foot_right/ankle_flex", {0, 0, -1}},
      {"torso/lumbar_flex", "head/neck_flex", {0, 0, 1}},
  };
  const std::vector<Rigid> rest = human_world_at_rest(human());
  for (const Turn& turn : turns) {
    std::vector<double> row(human().rest_coords().begin(), human().rest_coords().end());
    row[static_cast<std::size_t>(joint(human(), turn.joint).coord)] = 0.2;
    std::vector<Rigid> world(rest.size());
    forward_kinematics(human(), human().rest_root(), row, world);
    const auto watched = static_cast<std::size_t>(human().find_joint(turn.watched));
    EXPECT_GT(glm::dot(world[watched].p_m - rest[watched].p_m, turn.direction), 0.02) << turn.joint;
  }
}

// 5 kg at 18 cm behind and 25 cm above the lumbar joint; checked with the formula of the reference, not with merged().
TEST(Human, ABackpackBecomesPartOfTheTrunk) {
  const CharacterChoice choice{"human", {}, {{"backpack", "torso", "back"}}};
  const Joint& bare = joint(human(), "torso/lumbar_rot");
  const Character loaded_human = fixtures::built(choice);
  const Joint& loaded = joint(loaded_human, "torso/lumbar_rot");
  EXPECT_NEAR(loaded.mass_kg, bare.mass_kg + 5.0, 1e-12);
  const Vec3 pack_m(0, 0.25, -0.18);
  const Vec3 center_m = (23.572 * Vec3(0, 0.2255, 0) + 5.0 * pack_m) / 28.572;
  EXPECT_LT(length(loaded.center_of_mass_m - center_m), 1e-12);
  const Vec3 d = pack_m - Vec3(0, 0.2255, 0);
  const double reduced_kg = 23.572 * 5.0 / 28.572;
  const Vec3 pack_kg_m2 = 5.0 / 12 * Vec3(0.4 * 0.4 + 0.15 * 0.15, 0.3 * 0.3 + 0.15 * 0.15, 0.3 * 0.3 + 0.4 * 0.4);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(loaded.inertia_kg_m2[i][i],
                bare.inertia_kg_m2[i][i] + pack_kg_m2[i] + reduced_kg * (glm::dot(d, d) - d[i] * d[i]), 1e-6);
  EXPECT_NEAR(loaded.inertia_kg_m2[1][2], -reduced_kg * d.y * d.z, 1e-12);
  EXPECT_EQ(loaded.inertia_kg_m2[1][2], loaded.inertia_kg_m2[2][1]);
}

}  // namespace
}  // namespace contort
