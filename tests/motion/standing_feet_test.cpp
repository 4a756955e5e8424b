// Standing feet: legs whose hips a trunk moves, and legs that have actions of their own.
#include "generator/motion/standing_feet.h"

#include <gtest/gtest.h>

#include "generator/execute.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "tests/character/stock.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

// A figure at rest on level ground whose feet were seen to stand.
struct Standing {
  explicit Standing(const std::string& name) : character(fixtures::built({name, {}, {}})) {
    legs = find_legs(character);
    row.assign(character.rest_coords().begin(), character.rest_coords().end());
    world.resize(character.joints().size());
    forward_kinematics(character, character.rest_root(), row, world);
    feet.begin(character, legs, level);
    for (std::size_t leg = 0; leg < legs.size(); ++leg) feet.note(leg, LegUse::idle, world);
  }

  Rigid sole(std::size_t leg) const { return world_from_socket(character, world, legs[leg].sole); }
  // Turns the first joint of a part, with all bodies that it carries.
  void turn(int part, double angle_rad) {
    const Joint& joint = character.joint(character.parts()[at(part)].first_joint);
    row[at(joint.coord)] += angle_rad;
    forward_kinematics(character, character.rest_root(), row, world);
  }

  Character character;
  Environment level;
  std::vector<Leg> legs;
  std::vector<double> row;
  std::vector<Rigid> world;
  StandingFeet feet;
};

TEST(StandingFeet, AFootIsPlantedWhereATrunkCarriesItsLeg) {
  Standing quadruped("quadruped"), human("human");
  int planted = 0;
  for (std::size_t leg = 0; leg < quadruped.legs.size(); ++leg) planted += quadruped.feet.is_planted(leg);
  EXPECT_EQ(planted, 2) << "the fore legs; the root part carries the hind legs";
  EXPECT_FALSE(human.feet.is_planted(0));
}

TEST(StandingFeet, APlantedFootStaysWhenTheTrunkTurns) {
  Standing quadruped("quadruped");
  const int trunk = quadruped.character.find_part("trunk");
  for (std::size_t leg = 0; leg < quadruped.legs.size(); ++leg) {
    if (!quadruped.feet.is_planted(leg)) continue;
    const Rigid stood = quadruped.sole(leg);
    quadruped.turn(trunk, 0.05);
    EXPECT_GT(length(quadruped.sole(leg).p_m - stood.p_m), 0.005);
    EXPECT_TRUE(quadruped.feet.plant(leg, quadruped.world, quadruped.row));
    EXPECT_LT(length(quadruped.sole(leg).p_m - stood.p_m), 1e-6);
    quadruped.turn(trunk, -0.05);
  }
}

TEST(StandingFeet, AFootIsLiftedTheMoreTheFartherItGoes) {
  double lifted_m = 0.0;
  for (const double angle_rad : {0.01, 0.02, 0.04}) {
    Standing human("human");
    human.turn(human.legs[0].part, angle_rad);
    ASSERT_LT(human.feet.room_m(0, human.world), 0.0) << angle_rad;
    ASSERT_TRUE(human.feet.lift(0, human.world, human.row)) << angle_rad;
    EXPECT_GE(human.feet.room_m(0, human.world), -1e-9) << angle_rad;
    EXPECT_GT(human.sole(0).p_m.y, lifted_m) << angle_rad;
    lifted_m = human.sole(0).p_m.y;
  }
  EXPECT_GT(lifted_m, 0.004);
}

TEST(StandingFeet, AFootThatIsWellAboveTheGroundStandsNoMore) {
  Standing human("human");
  human.turn(human.legs[0].part, 0.6);
  human.feet.note(0, LegUse::acts, human.world);
  EXPECT_FALSE(human.feet.lift(0, human.world, human.row));
  EXPECT_EQ(human.feet.room_m(0, human.world), std::numeric_limits<double>::infinity());
}

Spec alone(const std::string& character, const ActionUse& action) {
  Spec spec;
  spec.character.name = character;
  spec.hold_frames = 30;
  spec.sequences = {sequence({action})};
  return spec;
}

// The farthest that a sole gets from where it stood at first.
double farthest_m(const std::string& character, const ActionUse& action, std::size_t leg) {
  const Result<Stage> stage = build_stage(alone(character, action), stock_library());
  const Motion motion = generate(*stage);
  Standing figure(character);
  const Rigid stood = figure.sole(leg);
  double farthest = 0.0;
  for (int f = 0; f < motion.frame_count; ++f) {
    forward_kinematics(figure.character, motion.root[at(f)], motion.row(f), figure.world);
    farthest = std::max(farthest, length(figure.sole(leg).p_m - stood.p_m));
  }
  return farthest;
}

int findings_of(const std::string& character, const ActionUse& action) {
  const Result<Stage> stage = build_stage(alone(character, action), stock_library());
  if (!stage) ADD_FAILURE() << to_line(stage.issue());
  StageEvaluator evaluator;
  const Evaluation evaluation = evaluator.run(*stage);
  for (const Finding& finding : evaluation.findings) ADD_FAILURE() << finding.check << " " << finding.subject;
  return static_cast<int>(evaluation.findings.size());
}

TEST(StandingFeet, AnAnimalThatTurnsItsTrunkDragsNoPaws) {
  for (const double azimuth_deg : {-40.0, 15.0, 90.0})
    EXPECT_EQ(findings_of("quadruped", use("direction", "trunk", 0, 60, {{"azimuth_deg", azimuth_deg}})), 0);
}

TEST(StandingFeet, ALegThatIsHitLiftsItsFootAndPutsItBack) {
  for (const char* character : {"human", "mech"})
    for (const double azimuth_deg : {0.0, 90.0, 180.0}) {
      const ActionUse hit = use("hit_reaction", "leg_left", 0, 60, {{"azimuth_deg", azimuth_deg}});
      EXPECT_EQ(findings_of(character, hit), 0);
      EXPECT_GT(farthest_m(character, hit, 0), 0.02) << "the leg gives way";
    }
}

// The foot bears the figure while it bends.
TEST(StandingFeet, ALegThatIsHitInASquatKeepsItsFootDown) {
  Spec spec = alone("human", use("squat", "waist", 0, 90, {{"share", 0.2}}));
  spec.sequences[0].clips[0].actions.push_back(use("hit_reaction", "leg_left", 20, 40, {{"strength_deg", 40.0}}));
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage);
  StageEvaluator evaluator;
  for (const Finding& finding : evaluator.run(*stage).findings) ADD_FAILURE() << finding.check << " " << finding.subject;
}

// The leg is in the air when the walk takes it over.
TEST(StandingFeet, AWalkAfterAReachOfALegDoesNotPop) {
  Spec spec = alone("human", use("reach", "leg_left", 0, 60, {{"target_m", Vec3(0.3, 0.5, 0.3)}}));
  ActionUse walk = use("walk", "waist", 0, 180, {{"speed_m_s", 0.8}});
  walk.blend_in_frames = -1;
  spec.sequences.push_back(sequence({walk}));
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage);
  StageEvaluator evaluator;
  for (const Finding& finding : evaluator.run(*stage).findings) EXPECT_NE(finding.check, "pop") << finding.subject;
}

TEST(StandingFeet, ALegReachesOverTheGroundAndNotIntoIt) {
  for (const Vec3 target_m : {Vec3(0.3, 0.5, 0.3), Vec3(0.1, -0.2, 0.4), Vec3(0.2, 0.1, -0.4)}) {
    ActionUse reach = use("reach", "leg_left", 0, 90, {{"target_m", target_m}});
    EXPECT_EQ(findings_of("human", reach), 0);
    EXPECT_GT(farthest_m("human", reach, 0), 0.1) << "the leg goes there";
  }
}

}  // namespace
}  // namespace contort
