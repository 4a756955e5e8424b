// Joints with impossible targets stay near the possible motion.
#include "generator/dynamics/racing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "generator/generate.h"
#include "generator/stage.h"
#include "tests/dynamics/states.h"

namespace contort {
namespace {

constexpr const char* kCharacters[] = {"human", "mech", "quadruped"};

Stage stage_of(std::string_view json) {
  const Result<Spec> spec = parse_spec(json);
  if (!spec) throw std::logic_error(to_line(spec.issue()));
  Result<Stage> stage = build_stage(*spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return std::move(stage).value();
}

Stage standing(const std::string& name) {
  return stage_of(R"({"format": "contort.spec/1", "character": {"name": ")" + name +
                  R"("}, "dynamics": {"mode": "tracking"}})");
}

// The speed of a joint, over all its freedoms: rad/s or m/s.
double speed_of(const Link& link, std::span<const double> velocity) {
  double squared = 0.0;
  for (int k = 0; k < link.dof_count; ++k) {
    const double rate = velocity[static_cast<std::size_t>(link.dof + k)];
    squared += rate * rate;
  }
  return std::sqrt(squared);
}

// The law of both functions, for velocities from a tenth of the bound to ten times the bound.
TEST(Racing, BoundsSpeedsKeepsDirectionsAndLeavesAllElseAsItIs) {
  std::mt19937_64 random(1);
  for (const char* name : kCharacters) {
    const Stage stage = standing(name);
    const DynamicFigure& figure = stage.dynamics->figure;
    for (int i = 0; i < 200; ++i) {
      std::vector<double> before = fixtures::any_state(figure.body, random).velocity;
      const double scale = std::pow(10.0, fixtures::between(random, -1.0, 2.0));
      for (double& rate : before) rate *= scale;
      std::vector<double> after = before;
      stop_racing(figure.body, figure.fastest, after);
      bool raced = false;
      for (const Link& link : figure.body.links()) {
        const double most = kRacing * figure.fastest[static_cast<std::size_t>(link.dof)];
        const double speed = speed_of(link, before);
        if (link.kind == JointKind::root) continue;
        const bool bounded = speed > most;
        raced = raced || bounded;
        EXPECT_NEAR(speed_of(link, after), bounded ? most : speed, 1e-12 * speed);
        for (int k = link.dof; k < link.dof + link.dof_count; ++k) {
          const auto at = static_cast<std::size_t>(k);
          if (bounded)
            EXPECT_NEAR(after[at], before[at] * most / speed, 1e-12 * speed);
          else
            EXPECT_EQ(after[at], before[at]);
        }
      }
      const std::vector<double> none(before.size(), 0.0);
      EXPECT_EQ(races(figure.body, figure.fastest, before, none, 0.01), raced);
      std::vector<double> stop = before;
      for (double& rate : stop) rate /= -0.01;
      EXPECT_FALSE(races(figure.body, figure.fastest, before, stop, 0.01)) << "it stands after that tick";
    }
  }
}

TEST(Racing, BoundsTheSpinOfTheRoot) {
  const Stage stage = standing("human");
  const DynamicFigure& figure = stage.dynamics->figure;
  std::vector<double> velocity(static_cast<std::size_t>(figure.body.dof_count()), 0.0);
  velocity[0] = 50.0, velocity[3] = 300.0, velocity[5] = -400.0;
  stop_racing(figure.body, figure.fastest, velocity);
  EXPECT_EQ(velocity[0], 50.0);
  EXPECT_NEAR(velocity[3], 0.6 * kFastestSpin_rad_s, 1e-9);
  EXPECT_NEAR(velocity[5], -0.8 * kFastestSpin_rad_s, 1e-9);
}

// A target whose limbs are flung about: random postures, and a root that spins at 110 m/s in the air.
Motion flung(const Character& character, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Motion motion;
  motion.rate_hz = 60.0, motion.frame_count = 60, motion.coord_count = character.coord_count();
  motion.coords.assign(static_cast<std::size_t>(motion.frame_count * motion.coord_count), 0.0);
  for (int f = 0; f < motion.frame_count; ++f) {
    std::ranges::copy(character.rest_coords(), motion.row(f).begin());
    for (const Joint& joint : character.joints())
      if (joint.kind == JointKind::hinge)
        motion.row(f)[static_cast<std::size_t>(joint.coord)] = fixtures::between(random, -3.0, 3.0);
    const Vec3 axis(fixtures::between(random, -1.0, 1.0), 1.0, fixtures::between(random, -1.0, 1.0));
    motion.root.push_back({axis_angle(glm::normalize(axis), 0.3 * f), Vec3(0.0, 37.0, 1.8 * f)});
  }
  return motion;
}

// No force acts in the air, so the centre of mass keeps its speed. The root once ran away at 1e9 m/s, and became NaN.
TEST(Racing, AFigureThatIsFlungAboutKeepsItsSpeed) {
  Stage stage = stage_of(R"({"format": "contort.spec/1", "character": {"name": "human"},
                             "dynamics": {"mode": "dynamic"}})");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    stage.recorded = std::make_shared<const Motion>(flung(*stage.character, seed));
    const Motion motion = generate(stage);
    const double first_m = length(motion.root[1].p_m - motion.root[0].p_m);
    for (std::size_t f = 1; f < motion.root.size(); ++f)
      ASSERT_LT(length(motion.root[f].p_m - motion.root[f - 1].p_m), 2.0 * first_m) << seed << " " << f;
  }
}

// Greatest ratio of a hinge's or travel's speed between two frames to its limit.
double greatest_speed_ratio(const Stage& stage, const Motion& motion) {
  double greatest = 0.0;
  for (int frame = 1; frame < motion.frame_count; ++frame)
    for (const Joint& joint : stage.character->joints()) {
      if (joint.kind != JointKind::hinge && joint.kind != JointKind::prismatic) continue;
      const auto at = static_cast<std::size_t>(joint.coord);
      const double moved = std::fabs(motion.row(frame)[at] - motion.row(frame - 1)[at]);
      greatest = std::max(greatest, moved * motion.rate_hz / joint.max_speed);
    }
  return greatest;
}

// A dog that leans forward by 73 degrees would have to fold its fore legs through themselves. Held by its paws it went
// round ever faster, to 1e16 times its strength and then to nan.
TEST(Racing, ALegThatIsToFoldThroughItselfLetsItsFeetGo) {
  const Stage stage = stage_of(R"({"format": "contort.spec/1", "character": {"name": "quadruped"},
    "dynamics": {"mode": "tracking"},
    "sequences": [{"clips": [{"actions": [{"action": "squat", "slot": "hips",
      "params": {"back_m": -0.04, "lean_deg": 73.0}}]}]}]})");
  const Motion motion = generate(stage);
  EXPECT_LE(greatest_speed_ratio(stage, motion), kRacing + 1e-9);
  for (const Rigid& root : motion.root) EXPECT_LT(glm::length(root.p_m - motion.root[0].p_m), 0.5);
  EXPECT_LT(glm::length(motion.root.back().p_m - motion.root[0].p_m), 0.2) << "it is back where it began";
}

// A blow of 51 N s swings an arm that holds 5 kg. Its shoulder went round at 150 rad/s, which no muscle could bear,
// and carried the figure 3 m up.
TEST(Racing, AnArmThatABlowSwingsDoesNotCarryTheFigureAway) {
  const Stage stage = stage_of(R"({"format": "contort.spec/1",
    "character": {"name": "human", "attachments": [{"object": "backpack", "slot": "torso", "socket": "back"}]},
    "dynamics": {"mode": "dynamic", "impacts": [{"impulse_N_s": [-34.5, 0.0, -37.0], "slot": "hand_right"}],
      "loads": [{"slot": "waist", "socket": "torso"}, {"slot": "hand_right", "socket": "grip"}]},
    "environment": {"ground": {"heading_deg": -117.0, "type": "slope"}}, "hold_frames": 16})");
  const Motion motion = generate(stage);
  EXPECT_LE(greatest_speed_ratio(stage, motion), kRacing + 1e-9);
  for (const Rigid& root : motion.root) EXPECT_LT(root.p_m.y - motion.root[0].p_m.y, 0.1);
}

}  // namespace
}  // namespace contort
