// Single actions of figures with mass, as an audit draws them, without a finding.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "generator/dynamics/contact_plan.h"
#include "generator/dynamics/foot_lifts.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "tests/character/stock.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

using Parts = std::map<std::string, std::string>;  // slot -> part

Stage stage_with_mass(const char* character, const ActionUse& action, const Parts& parts = {}) {
  Spec spec;
  spec.character.name = character;
  spec.character.parts = parts;
  spec.hold_frames = 30;
  spec.dynamics.mode = Mode::tracking;
  spec.sequences = {sequence({action})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return *stage;
}

std::vector<Finding> found_in(const Stage& stage) {
  StageEvaluator evaluator;
  return evaluator.run(stage).findings;
}

ActionUse blow(double azimuth_deg, double strength_deg, int frames) {
  return use("hit_reaction", "leg_left", 0, frames, {{"azimuth_deg", azimuth_deg}, {"strength_deg", strength_deg}});
}

TEST(SingleActions, ALegThatIsStruckAsksNoMoreOfTheOtherThanItsStrength) {
  EXPECT_TRUE(found_in(stage_with_mass("mech", blow(75.0, 15.0, 72))).empty());
  EXPECT_TRUE(found_in(stage_with_mass("mech", blow(25.0, 43.0, 65), {{"leg_left", "mech_leg_reverse"}})).empty());
}

// Hips of 900 N m could not hold what stands on one leg: 459 kg, 0.2 m beside it.
TEST(SingleActions, AMechOfTheHeaviestPartsStandsOnEitherOfItsLegs) {
  for (const char* leg : {"mech_leg_human", "mech_leg_reverse"}) {
    const Parts heaviest{{"torso", "mech_torso_heavy"}, {"back", "mech_pack_large"},      {"arm_left", "mech_arm_shield"},
                         {"leg_left", leg},             {"arm_right", "mech_arm_shield"}, {"leg_right", leg}};
    for (const char* lifted : {"leg_left", "leg_right"})
      EXPECT_TRUE(found_in(stage_with_mass("mech", use("reach", lifted, 0, 60, {}), heaviest)).empty()) << leg << lifted;
  }
}

// The leg was softened up to 0.35 s before the hips begin to turn, and jumped by 6 degrees there.
TEST(SingleActions, ALegThatIsStruckBeforeTheFigureTurnsHasNoJump) {
  Spec spec;
  spec.character.name = "mech";
  spec.dynamics.mode = Mode::tracking;
  const ActionUse struck = use("hit_reaction", "leg_right", 0, 29, {{"azimuth_deg", -8.0}, {"strength_deg", 41.0}});
  spec.sequences = {sequence({struck, use("aim", "head", 24, 30, {{"target_m", Vec3(0.0, 1.2, -0.1)}})})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  EXPECT_EQ(broken_in(*stage), "");
}

// The figure sways over one leg, so that the arm is aimed again. Its shoulder turned to the new aim within a frame.
TEST(SingleActions, AShoulderThatIsAimedAgainTurnsThereLittleByLittle) {
  Spec spec;
  spec.character = {"mech", {{"arm_left", "mech_arm_extend"}}, {}};
  spec.dynamics.mode = Mode::tracking;
  ActionUse aim = use("aim", "arm_left", 0, 73, {}), reach = use("reach", "leg_left", 0, 30, {});
  aim.blend_in_frames = reach.blend_in_frames = ActionUse().blend_in_frames;
  spec.sequences = {sequence({aim, reach})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  EXPECT_EQ(broken_in(*stage), "");
}

// A load of 5 kg on a figure of 420 kg switched to another way of tracking, which jolts: the zero moment point went
// 5 cm out of the support area.
TEST(SingleActions, ALoadThatAFigureHardlyFeelsDoesNotChangeHowItFollows) {
  Spec spec;
  spec.character.name = "mech";
  spec.dynamics.mode = Mode::tracking;
  spec.dynamics.loads = {LoadDesc{.slot = "torso", .socket = "back"}};
  ActionUse struck = use("hit_reaction", "torso", 0, ActionUse().duration_frames, {});
  struck.blend_in_frames = ActionUse().blend_in_frames;
  spec.sequences = {sequence({struck})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  EXPECT_EQ(broken_in(*stage), "");
}

// The crouch faded so fast that the ground would have had to pull: the centre of mass of a dog is far ahead of its
// hips, and rises when they stop leaning.
TEST(SingleActions, ADogRisesFromALeaningCrouchNoFasterThanItsWeightAllows) {
  for (const int fades_frames : {1, 3, 6, 9}) {
    Spec spec;
    spec.character.name = "quadruped";
    spec.dynamics.mode = Mode::tracking;
    ActionUse crouch = use("crouch", "hips", 0, 45, {{"lean_deg", 11.0}});
    crouch.blend_in_frames = ActionUse().blend_in_frames, crouch.blend_out_frames = fades_frames;
    spec.sequences = {sequence({crouch})};
    spec.hold_frames = 20;
    const Result<Stage> stage = build_stage(spec, stock_library());
    ASSERT_TRUE(stage) << to_line(stage.issue());
    EXPECT_EQ(broken_in(*stage), "") << fades_frames;
  }
}

// The hips fell by 4 mm in the frame in which a bend ended, as legs that stand apart are left easily bent; a figure with
// mass keeps its knees bent anyway. Both feet were in the air afterwards.
TEST(SingleActions, HipsAreAsHighAfterABendAsBefore) {
  for (const char* character : {"human", "mech"})
    for (const char* action : {"squat", "crouch"})
      for (const int fades_frames : {1, 3, 6}) {
        ActionUse bend = use(action, "waist", 0, 45, {{"share", 0.0}});
        bend.blend_out_frames = fades_frames;
        const Stage stage = stage_with_mass(character, bend);
        EXPECT_EQ(broken_in(stage), "") << character << " " << action << " " << fades_frames;
        Stage kinematic = stage;
        kinematic.dynamics = nullptr;
        const Motion target = generate(kinematic);
        EXPECT_NEAR(target.root.back().p_m.y, target.root.front().p_m.y, 1e-4) << character << " " << action;
      }
}

// The hips stop in the frame in which a bend is cut by its end, and legs that stopped little by little, as joints at ease
// do, carried both feet forward by 20 cm, and into the air.
TEST(SingleActions, FeetStayOnTheGroundWhereABendIsCut) {
  for (const char* character : {"human", "mech"})
    for (const char* action : {"squat", "crouch"}) {
      ActionUse bend = use(action, "waist", 0, 30, {});
      bend.speed = 0.8, bend.blend_in_frames = bend.blend_out_frames = ActionUse().blend_in_frames;
      Stage stage = stage_with_mass(character, bend);
      stage.dynamics = nullptr;
      const Motion target = generate(stage);
      std::vector<Rigid> world(stage.character->joints().size());
      for (const Leg& leg : stage.legs)
        for (int frame = 30; frame < target.frame_count; ++frame) {
          forward_kinematics(*stage.character, target.root[at(frame)], target.row(frame), world);
          const Rigid sole = world_from_socket(*stage.character, world, leg.sole);
          const Vec3 toes = sole * Vec3(0.0, 0.0, leg.high_m.z);
          EXPECT_NEAR(toes.y, 0.0, 1e-3) << character << " " << action << " " << frame;
        }
    }
}

// It leaves the ground in the first frame, and its edge touches the ground on the way.
TEST(SingleActions, AStruckFootIsLiftedOnceFromWhereItStood) {
  const Stage stage = stage_with_mass("mech", blow(25.0, 43.0, 65), {{"leg_left", "mech_leg_reverse"}});
  Stage kinematic = stage;
  kinematic.dynamics = nullptr;
  const Motion motion = generate(kinematic);
  const ContactPlan plan(*stage.character, stage.dynamics->figure, stage.environment, motion);
  const std::vector<FootLift> lifts = foot_lifts(plan, 2);
  ASSERT_EQ(lifts.size(), 1U);
  EXPECT_LT(length(lifts[0].to.p_m - lifts[0].from.p_m), 0.01);
}

// The leg followed its reaction slowly, but its foot was lifted at once: the foot went half a metre ahead of its place.
TEST(SingleActions, AStruckFootGoesWhereTheBlowTakesItAndComesBack) {
  const Stage stage = stage_with_mass("mech", blow(119.0, 39.0, 39));
  const Motion motion = generate(stage);
  std::vector<Rigid> world(stage.character->joints().size());
  std::vector<double> ahead_m;
  for (int f = 0; f < motion.frame_count; ++f) {
    forward_kinematics(*stage.character, motion.root[at(f)], motion.row(f), world);
    const bool is_first = stage.character->parts()[at(stage.legs[0].part)].slot == "leg_left";
    const Leg& leg = stage.legs[is_first ? 0 : 1];
    ahead_m.push_back(world_from_socket(*stage.character, world, leg.sole).p_m.z);
  }
  EXPECT_NEAR(ahead_m.front(), 0.0, 1e-3) << "it stands in the first frame";
  EXPECT_LT(*std::ranges::min_element(ahead_m), -0.02) << "the blow comes from ahead";
  EXPECT_LT(*std::ranges::max_element(ahead_m), 0.005);
  EXPECT_NEAR(ahead_m.back(), 0.0, 1e-3);
}

// The lift of a foot that had to stop counted as its speed: the knee swung up to 74 degrees.
TEST(SingleActions, ALegThatStopsBesideAHandDoesNotSwingOn) {
  ActionUse reach = use("reach", "leg_left", 0, 60, {{"swivel_deg", 169.0}, {"target_m", Vec3(0.14, 0.06, 0.19)}});
  reach.blend_in_frames = -1;
  const Stage stage = stage_with_mass("human", reach);
  const Motion motion = generate(stage);
  const auto knee = at(fixtures::joint(*stage.character, "leg_left/knee").coord);
  for (int f = 0; f < motion.frame_count; ++f) EXPECT_LT(motion.row(f)[knee], 40.0 * kRadPerDeg) << f;
}

// Paws that stay while the trunk turns came 0.01 degrees beyond the ends of their joints.
TEST(SingleActions, LegsAtTheEndsOfTheirRangesStayInside) {
  for (const auto& [azimuth_deg, elevation_deg] : {std::pair(44.0, -73.0), std::pair(-80.0, -60.0)}) {
    ActionUse turn = use("direction", "trunk", 0, 89, {{"azimuth_deg", azimuth_deg}, {"elevation_deg", elevation_deg}});
    turn.blend_in_frames = -1;
    EXPECT_TRUE(found_in(stage_with_mass("quadruped", turn)).empty()) << azimuth_deg;
  }
}

// The trunk turns round over one foot. The other one bears next to nothing and gave a moment of 47 N m.
TEST(SingleActions, AFootThatBearsLittleGivesLittleMoment) {
  ActionUse look = use("look_at", "torso", 0, 41, {{"target_m", Vec3(1.5, 2.03, -0.63)}});
  look.blend_in_frames = -1;
  EXPECT_TRUE(found_in(stage_with_mass("human", look)).empty());
}

// The foot is slow at the top of its small step, 15 mm above the ground, and counted as one that bears there.
TEST(SingleActions, AFootThatStepsOnTheSpotIsInTheAirOnce) {
  ActionUse aim = use("aim", "torso", 0, 59, {{"point", std::string("chest")}, {"target_m", Vec3(-0.71, 2.21, 0.11)}});
  aim.blend_in_frames = -1;
  const Motion motion = generate(stage_with_mass("human", aim));
  for (const int foot : {0, 1}) {
    int lifts = 0;
    for (std::size_t f = 1; f < motion.response.stances.size(); ++f) {
      const auto stands = [&](std::size_t frame) { return (motion.response.stances[frame].planned >> foot & 1) != 0; };
      lifts += stands(f - 1) && !stands(f) ? 1 : 0;
    }
    EXPECT_EQ(lifts, 1) << foot;
  }
}

// The hips went 20 cm ahead within 0.3 s, which counted as a gait, whose hips do not come back towards standing.
TEST(SingleActions, AnklesStayInTheirRangesInACrouchFarAhead) {
  ActionUse crouch = use("crouch", "waist", 0, 41, {{"back_m", -0.44}, {"lean_deg", -30.0}, {"share", 0.46}});
  crouch.blend_in_frames = -1;
  for (const Finding& finding : found_in(stage_with_mass("human", crouch)))
    EXPECT_NE(finding.check, "joint_range") << finding.subject;
}

// Its balls get slower while it aims: a figure that follows misses a share of that in each of them.
TEST(SingleActions, ATailOfBallsPointsAtItsTargetWhileItSlowsDown) {
  ActionUse aim = use("aim", "tail", 0, 40, {{"point", std::string("tip")}, {"target_m", Vec3(-2.1, 1.1, -3.9)}});
  aim.blend_in_frames = -1;
  EXPECT_TRUE(found_in(stage_with_mass("quadruped", aim)).empty());
}

// Hips that sway uphill, and heels that rise before the hips are above the toes, took ankles beyond their ends.
TEST(SingleActions, AnklesStayInTheirRangesInSquatsOnSlopes) {
  for (const char* name : {"human", "mech"})
    for (const double slope_deg : {12.0, 16.0})
      for (const double heading_deg : {-60.0, 0.0, 20.0, 90.0, 180.0}) {
        Spec spec;
        spec.character.name = name;
        spec.hold_frames = 30;
        spec.dynamics.mode = Mode::tracking;
        SlopeGround slope;
        slope.slope_deg = slope_deg, slope.heading_deg = heading_deg;
        spec.environment.ground = slope;
        ActionUse squat = use("squat", "waist", 0, 30, {});
        squat.blend_in_frames = -1;
        spec.sequences = {sequence({squat})};
        for (const Finding& finding : found_in(*build_stage(spec, stock_library())))
          EXPECT_NE(finding.check, "joint_range") << name << " " << slope_deg << " " << heading_deg;
      }
}

// Neither leg lands before the end, so that the figure would float: with mass, one foot stays where it stands.
TEST(SingleActions, AFigureWithMassStandsOnOneLegWhileBothAreToReach) {
  Spec spec;
  spec.character.name = "mech";
  spec.dynamics.mode = Mode::tracking;
  spec.sequences = {sequence({use("reach", "leg_left", 10, 90, {{"target_m", Vec3(0.73, 1.5, 0.39)}}),
                              use("reach", "leg_right", 25, 75, {{"target_m", Vec3(-0.9, 1.13, 0.36)}})})};
  for (ActionUse& action : spec.sequences[0].clips[0].actions) action.blend_in_frames = -1;
  spec.sequences[0].clips[0].actions[0].blend_out_frames = 0;
  spec.sequences[0].clips[0].actions[1].blend_out_frames = 0;
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  EXPECT_EQ(broken_in(*stage), "");
  const Motion motion = generate(*stage);
  for (const Stance& stance : motion.response.stances) EXPECT_NE(stance.planned, 0);
}

}  // namespace
}  // namespace contort
