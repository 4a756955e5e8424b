// The height of colliders above the ground, against dense points on their surfaces.
#include <gtest/gtest.h>

#include <random>

#include "checks/check.h"
#include "tests/stage_evaluator.h"
#include "model/motion/kinematics.h"
#include "tests/checks/small_character.h"

namespace contort {
namespace {

Environment on(const Ground& ground) {
  EnvironmentDesc desc;
  desc.ground = ground;
  return *build_environment(desc);
}

// The least margin over all bodies of the figure at this place.
double least_margin(const Character& character, const Rigid& root, const Environment& environment) {
  const Motion at_rest = small::at_rest(character);
  std::vector<Rigid> world(character.joints().size());
  Motion motion = at_rest;
  motion.root[0] = root;
  forward_kinematics(character, root, motion.row(0), world);
  const CheckDef& check = small::check_named("ground_penetration");
  const CheckSettings settings;
  MarginFold fold(check.subject_count(character), 2);
  check.measure({character, motion, world, settings, environment, nullptr}, fold);
  return *std::ranges::min_element(fold.smallest());
}

// The same from every corner of the triangles that the colliders are drawn with.
double least_of_points(const Character& character, const Rigid& root, const Environment& environment) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, root, character.rest_coords(), world);
  double least = 1e9;
  for (const Collider& collider : character.colliders()) {
    const MeshShape mesh = std::visit([](const auto& shape) { return MeshShape(shape); }, collider.shape);
    for (const Vec3& point : tessellate(mesh).positions_m)
      least = std::min(least,
                       environment.nearest_ground(world[static_cast<std::size_t>(collider.joint)] * point).distance_m);
  }
  return least + 0.005;
}

TEST(GroundPenetration, AgreesWithPointsOnTheSurfaceOnPlanesAndSlopes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const Character human = *build_character({}, stock_library());
  for (int i = 0; i < 60; ++i) {
    const Environment environment = i % 2 == 0 ? on(PlaneGround{0.2}) : on(SlopeGround{20.0, 30.0});
    const Vec3 turn(3 * any(random), 3 * any(random), 3 * any(random));
    const Rigid root{from_rotation_vector(turn), Vec3(any(random), any(random), any(random))};
    const double exact = least_margin(human, root, environment), points = least_of_points(human, root, environment);
    EXPECT_LE(exact, points + 1e-9);       // no point of the surface is deeper
    EXPECT_GE(exact, points - 0.01) << i;  // tessellation cuts off at most this much
  }
}

TEST(GroundPenetration, AFigureThatStandsIsFiveMillimetresSafe) {
  for (const char* name : {"human", "mech", "quadruped"}) {
    const Character character = *build_character({name, {}, {}}, stock_library());
    EXPECT_NEAR(least_margin(character, character.rest_root(), Environment()), 0.005, 1e-9) << name;
  }
}

TEST(GroundPenetration, NoNumberIsAViolation) {
  const Character character = small::build();
  Rigid root = character.rest_root();
  root.p_m.x = std::numeric_limits<double>::quiet_NaN(), root.p_m.y = root.p_m.x;
  EXPECT_TRUE(std::isnan(least_margin(character, root, Environment())));
  Motion motion = small::at_rest(character);
  motion.root[0] = root;
  EXPECT_FALSE(StageEvaluator().judge(character, motion, "ground_penetration").empty());
}

TEST(GroundPenetration, JudgesTheGroundOfTheSpec) {
  Spec spec;
  spec.hold_frames = 2;
  spec.environment.ground = SlopeGround{10.0, 0.0};
  StageEvaluator evaluator;
  const Stage stage = *build_stage(spec, stock_library());
  EXPECT_TRUE(evaluator.run(stage, "ground_penetration").findings.empty());
  // On a plane the uphill foot of the same posture would float and the other one sink.
  Motion lowered = evaluator.motion();
  for (Rigid& root : lowered.root) root.p_m.y -= 0.02;
  EXPECT_FALSE(evaluator.judge(*stage.character, lowered, "ground_penetration", stage.environment).empty());
}

}  // namespace
}  // namespace contort
