// Whole simulations: impacts, falls, long motions, loads, errors in specs.
#include "generator/dynamics/simulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "generator/generate.h"
#include "tests/dynamics/states.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

Spec standing(const std::string& name, Mode mode, int frames) {
  Spec spec;
  spec.character.name = name;
  spec.rate_hz = 30.0;
  spec.hold_frames = frames;
  spec.dynamics.mode = mode;
  return spec;
}

Motion played(const Spec& spec) {
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return generate(*stage);
}

bool is_finite(const Motion& motion) {
  for (const double c : motion.coords)
    if (!std::isfinite(c)) return false;
  for (const Rigid& root : motion.root)
    if (!std::isfinite(root.p_m.x + root.p_m.y + root.p_m.z + root.q.w + root.q.x + root.q.y + root.q.z)) return false;
  return true;
}

bool has(const Motion& motion, Footing footing) {
  return std::ranges::any_of(motion.response.stances, [&](const Stance& s) { return s.footing == footing; });
}

ImpactDesc any_blow(const Character& character, double most_N_s, std::mt19937_64& random) {
  ImpactDesc blow;
  blow.frame = static_cast<int>(fixtures::between(random, 0, 20));
  const auto parts = character.parts();
  blow.slot =
      parts[static_cast<std::size_t>(fixtures::between(random, 0, static_cast<double>(parts.size()) - 1e-9))].slot;
  do blow.impulse_N_s = fixtures::any_vec(random, most_N_s);
  while (length(blow.impulse_N_s) > most_N_s);
  return blow;
}

// Counts the figures that lie on the ground after such blows. Every figure must stay finite and near its start.
int fallen_of(const std::string& name, int count, double most_N_s) {
  Spec spec = standing(name, Mode::dynamic, 60);
  const auto character = std::make_shared<const Character>(fixtures::built(spec.character));
  std::mt19937_64 random(1);
  GenerateScratch scratch;
  Motion motion;
  int fallen = 0;
  for (int i = 0; i < count; ++i) {
    spec.dynamics.impacts = {any_blow(*character, most_N_s, random)};
    generate(*build_stage(spec, character), scratch, motion);
    EXPECT_TRUE(is_finite(motion)) << name << " " << i;
    for (const Rigid& root : motion.root) {
      EXPECT_LT(length(root.p_m), 40.0) << name << " " << i;
      EXPECT_GT(root.p_m.y, -0.2) << name << " " << i;
    }
    fallen += has(motion, Footing::fallen);
  }
  return fallen;
}

// A figure that is struck in its last frame lets go there, and has had no tick to find its contacts in.
TEST(Simulate, TheFootingInTheLastFrameDoesNotDependOnEarlierMotions) {
  const auto struck = [](int frames, double impulse_N_s) {
    Spec spec;
    spec.character.name = "human";
    spec.hold_frames = frames;
    spec.dynamics = {Mode::dynamic, 0, {}, {{10, "torso", "", {}, {impulse_N_s, 0.0, 0.0}}}};
    return *build_stage(spec, stock_library());
  };
  const Stage in_last_frame = struck(10, 300.0), lies = struck(120, 400.0);
  GenerateScratch fresh, used;
  Motion first, fallen, again;
  generate(in_last_frame, fresh, first);
  generate(lies, used, fallen);
  generate(in_last_frame, used, again);
  EXPECT_EQ(fallen.response.stances.back().footing, Footing::fallen);
  EXPECT_NE(first.response.stances.back().footing, Footing::standing);
  EXPECT_EQ(again.response, first.response);
}

TEST(Simulate, AnyBlowStaysFiniteAndHardOnesFellTheFigure) {
  for (const char* name : {"human", "mech", "quadruped"}) EXPECT_GT(fallen_of(name, 40, 200.0), 0) << name;
}

// A suite for each character, as suites run side by side.
TEST(SimulateHumanSlow, TenThousandBlowsStayFinite) { EXPECT_GT(fallen_of("human", 10000, 200.0), 100); }
TEST(SimulateMechSlow, TenThousandBlowsStayFinite) { EXPECT_GT(fallen_of("mech", 10000, 200.0), 100); }
TEST(SimulateQuadrupedSlow, TenThousandBlowsStayFinite) { EXPECT_GT(fallen_of("quadruped", 10000, 200.0), 100); }

TEST(Simulate, AFigureThatStandsStaysWhereItIs) {
  for (const char* name : {"human", "mech", "quadruped"})
    for (const Mode mode : {Mode::tracking, Mode::dynamic}) {
      const Motion motion = played(standing(name, mode, 300));
      for (const Rigid& root : motion.root) EXPECT_LT(length(root.p_m - motion.root[0].p_m), 1e-4) << name;
      for (const Stance& stance : motion.response.stances) EXPECT_GT(stance.margin_m, 0.0) << name;
      EXPECT_FALSE(has(motion, Footing::tipping) || has(motion, Footing::fallen));
    }
}

TEST(Simulate, APushThatIsTooHardFellsItAndIsFlagged) {
  Spec spec = standing("human", Mode::dynamic, 90);
  spec.dynamics.impacts = {{5, "torso", "", {0, 0.3, 0}, {0, 0, -120}}};
  const Motion motion = played(spec);
  EXPECT_TRUE(has(motion, Footing::fallen));
  EXPECT_LT(motion.root.back().p_m.y, 0.5);
  EXPECT_LT((motion.root.back().q * Vec3(0, 1, 0)).y, 0.5);
}

// 20 kg in a hand that is held out ask more than 90 N m of the shoulder.
TEST(Simulate, ALoadTooHeavyToHoldOutIsFlagged) {
  for (const double mass_kg : {5.0, 20.0}) {
    Spec spec = standing("human", Mode::dynamic, 60);
    spec.sequences = {sequence({use("pose", "arm_left", 0, 60, {{"shoulder_deg", Vec3(-85, 0, 0)}})})};
    spec.dynamics.loads = {{"hand_left", "grip", {}, {0.2, 0.2, 0.2}, mass_kg}};
    const Motion motion = played(spec);
    const bool flagged = std::ranges::any_of(motion.response.stances, [](const Stance& s) { return s.overpowered; });
    EXPECT_EQ(flagged, mass_kg > 10.0) << mass_kg;
    EXPECT_TRUE(is_finite(motion));
  }
}

// Two minutes of successive squats: errors do not accumulate.
TEST(Simulate, TwoMinutesOfSquatsStayBounded) {
  for (const Mode mode : {Mode::tracking, Mode::dynamic}) {
    Spec spec = standing("human", mode, 0);
    spec.start.ahead_m = 0.04;
    std::vector<ActionUse> squats;
    for (int i = 0; i < 60; ++i)
      squats.push_back(use("squat", "waist", 60 * i, 60, {{"share", 0.2}, {"lean_deg", 25.0}, {"back_m", 0.12}}));
    spec.sequences = {sequence(squats)};
    const Motion motion = played(spec);
    ASSERT_EQ(motion.frame_count, 3601);
    for (int f = 0; f < motion.frame_count; ++f) {
      const auto at = static_cast<std::size_t>(f);
      EXPECT_LT(length(motion.root[at].p_m - motion.response.target_root[at].p_m), 0.03) << f;
    }
    EXPECT_TRUE(is_finite(motion));
    EXPECT_FALSE(has(motion, Footing::tipping));
  }
}

ActionUse held_crouch(int frames) {
  ActionUse crouch = use("crouch", "waist", 0, frames, {{"share", 0.3}, {"lean_deg", 65.0}, {"back_m", 0.3}});
  crouch.speed = 4.0;  // down in a quarter of the time, then held
  return crouch;
}

// Against fixed thresholds, and without a lag, relief once shook the arms by 100 degrees. Down after 2 s; a second
// later.
TEST(Simulate, ReliefOfALoadThatStaysComesToRest) {
  Spec spec = standing("human", Mode::dynamic, 0);
  spec.start.ahead_m = 0.04;
  spec.sequences = {sequence({held_crouch(240)})};
  spec.dynamics.loads = {{"torso", "back", {0, 0, -0.075}, {0.3, 0.4, 0.15}, 12.0}};
  const Motion motion = played(spec);
  EXPECT_FALSE(has(motion, Footing::tipping));
  const auto n = static_cast<std::size_t>(motion.response.dof_count);
  double largest = 0.0, change = 0.0;
  for (std::size_t f = 90; f < 120; ++f)
    for (std::size_t k = 0; k < n; ++k) {
      largest = std::max(largest, std::fabs(motion.response.control[f * n + k]));
      change =
          std::max(change, std::fabs(motion.response.control[(f + 1) * n + k] - motion.response.control[f * n + k]));
    }
  EXPECT_GT(largest, 1.0);            // it is there,
  EXPECT_LT(change, 0.05 * largest);  // still
}

// Without a share of strength that is always bearable it once fought the 15 N m of a load on an upright back.
TEST(Simulate, ALoadThatIsBearableAnywayChangesNothing) {
  Spec spec = standing("human", Mode::dynamic, 60);
  spec.start.ahead_m = 0.04;
  spec.dynamics.loads = {{"torso", "back", {0, 0, -0.075}, {0.3, 0.4, 0.15}, 8.0}};
  for (const double added : played(spec).response.control) ASSERT_EQ(added, 0.0);
}

// It once counted as a blow after which joints have to be back at their targets in time.
TEST(Simulate, ABlowOfNothingIsNone) {
  Spec spec = standing("human", Mode::dynamic, 60);
  spec.dynamics.loads = {{"hand_left", "grip", {0, 0, 0}, {0.3, 0.3, 0.3}, 25.0}};
  const Motion without = played(spec);
  spec.dynamics.impacts = {{20, "torso", "", Vec3(0.0), Vec3(0.0)}};
  const Motion with = played(spec);
  EXPECT_TRUE(with.response.impacts.empty());
  EXPECT_EQ(motion_hash(with), motion_hash(without));
}

// Clamping joints one by one once pulled the feet apart. With weak legs the squat is slower, but its soles stay.
TEST(Simulate, WithLittleStrengthASquatIsHeldBackAsAWhole) {
  Spec spec = standing("human", Mode::dynamic, 30);
  spec.start.ahead_m = 0.04;
  spec.sequences = {sequence({use("squat", "waist", 0, 40, {{"share", 0.3}, {"lean_deg", 40.0}, {"back_m", 0.21}})})};
  const Stage stage = *build_stage(spec, stock_library());
  DynamicsSetup weak = *stage.dynamics;
  for (double& limit : weak.figure.strength_low) limit *= 0.5;
  for (double& limit : weak.figure.strength_high) limit *= 0.5;
  Stage still = stage;
  still.dynamics = nullptr;
  Motion motion = generate(still);
  SimulationScratch scratch;
  simulate(*stage.character, weak, stage.environment, scratch, motion);
  EXPECT_TRUE(is_finite(motion));
  EXPECT_FALSE(has(motion, Footing::fallen));
  for (std::size_t k = 0; k < motion.response.efforts.size(); ++k) {
    const std::size_t dof = k % static_cast<std::size_t>(motion.response.dof_count);
    const bool flagged = motion.response.stances[k / static_cast<std::size_t>(motion.response.dof_count)].overpowered;
    EXPECT_TRUE(flagged || motion.response.efforts[k] <= weak.figure.strength_high[dof] * (1 + 1e-9)) << k;
  }
}

TEST(Simulate, NamesThatAreNotThereAreErrorsWithPointers) {
  const auto issue_of = [](const DynamicsDesc& dynamics) {
    Spec spec = standing("human", Mode::dynamic, 1);
    spec.dynamics = dynamics;
    const Result<Stage> stage = build_stage(spec, stock_library());
    return stage ? std::string("none") : stage.issue().code + " " + stage.issue().pointer;
  };
  EXPECT_EQ(issue_of({Mode::dynamic,
                      0,
                      {{"torso", "back", {}, {0.1, 0.1, 0.1}, 1.0}, {"tail", "back", {}, {0.1, 0.1, 0.1}, 1.0}},
                      {}}),
            "dynamics.unknown_name /dynamics/loads/1/slot");
  EXPECT_EQ(issue_of({Mode::dynamic, 0, {{"torso", "front", {}, {0.1, 0.1, 0.1}, 1.0}}, {}}),
            "dynamics.unknown_name /dynamics/loads/0/socket");
  EXPECT_EQ(issue_of({Mode::dynamic, 0, {}, {{0, "wing", "", {}, {}}}}),
            "dynamics.unknown_name /dynamics/impacts/0/slot");
  EXPECT_EQ(issue_of({Mode::kinematic, 0, {}, {{0, "head", "elbow", {}, {}}}}),
            "dynamics.unknown_name /dynamics/impacts/0/joint");
  EXPECT_EQ(
      issue_of({Mode::dynamic, 3, {{"torso", "back", {}, {0.1, 0.1, 0.1}, 1.0}}, {{0, "head", "neck_rot", {}, {}}}}),
      "none");
}

// A load is part of its link: the forces with it are those without it plus the force to move it along.
TEST(Simulate, AMergedLoadWeighsWhatItTakesToMoveIt) {
  const Character& character = fixtures::human();
  const Load load = box_load(character.find_joint("torso/lumbar_rot"), {axis_angle(Vec3(0, 1, 0), 0.4), {0, 0.2, -0.2}},
                             {0.3, 0.4, 0.15}, 8.0);
  Multibody with = Multibody::of(character);
  const Multibody without = with;
  with.add_mass(load.link, load.mass_kg, load.center_of_mass_m, load.inertia_kg_m2);
  EXPECT_NEAR(with.mass_kg(), without.mass_kg() + 8.0, 1e-12);
  std::mt19937_64 random(3);
  for (int i = 0; i < 50; ++i) {
    const fixtures::DynamicsState state = fixtures::any_state(with, random);
    DynamicsScratch scratch;
    std::vector<double> loaded(state.velocity.size()), plain(state.velocity.size());
    place(with, state.root, state.coords, scratch);
    inverse_dynamics(with, state.velocity, state.acceleration, kGravity_m_s2, scratch, loaded);
    const Placement& link = scratch.world[static_cast<std::size_t>(load.link)];
    const SpatialForce force = force_of(
        placed_inertia(load.mass_kg, load.center_of_mass_m, load.inertia_kg_m2, link, scratch.world[0].origin_m),
        scratch.velocity[static_cast<std::size_t>(load.link)],
        scratch.acceleration[static_cast<std::size_t>(load.link)]);
    const Link& last = with.links()[static_cast<std::size_t>(load.link)];
    place(without, state.root, state.coords, scratch);
    inverse_dynamics(without, state.velocity, state.acceleration, kGravity_m_s2, scratch, plain);
    for (int k = last.dof; k >= 0; k = with.parent_dof()[static_cast<std::size_t>(k)])
      plain[static_cast<std::size_t>(k)] += dot(scratch.freedoms[static_cast<std::size_t>(k)], force);
    for (std::size_t k = 0; k < plain.size(); ++k)
      EXPECT_NEAR(loaded[k], plain[k], 1e-10 * (1.0 + std::fabs(plain[k])));
  }
}

}  // namespace
}  // namespace contort
