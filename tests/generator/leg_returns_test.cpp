// Legs that an action has moved return to where their feet stood, or stay on the ground, and keep their distance and
// speeds on the way.
#include <gtest/gtest.h>

#include "model/motion/kinematics.h"
#include "model/motion/legs.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

std::shared_ptr<const Character> stock(const char* name) {
  return std::make_shared<const Character>(fixtures::built({name, {}, {}}));
}

Vec3 paw_m(const Character& character, const Motion& motion, int frame) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, motion.root[static_cast<std::size_t>(frame)], motion.row(frame), world);
  for (const Leg& leg : find_legs(character))
    if (character.parts()[static_cast<std::size_t>(leg.part)].slot == "leg_fore_right")
      return world_from_socket(character, world, leg.sole).p_m;
  return Vec3(0.0);
}

ActionUse blow(const char* slot, int start_frame, int frames, double azimuth_deg) {
  return use("hit_reaction", slot, start_frame, frames, {{"azimuth_deg", azimuth_deg}});
}

TEST(LegReturns, AHitLegOnATrunkThatBendsPutsItsPawBackWhereItStood) {
  const auto dog = stock("quadruped");
  for (const double elevation_deg : {-25.0, 20.0})
    for (const int start_frame : {0, 2, 20, 45}) {
      const ActionUse bend = use("direction", "trunk", 0, 40, {{"elevation_deg", elevation_deg}});
      const Stage stage =
          fixtures::stage_of({sequence({bend, blow("leg_fore_right", start_frame, 30, 0.0)})}, 20, dog);
      EXPECT_EQ(broken_in(stage), "") << elevation_deg << " degrees, hit at " << start_frame;
      const Motion motion = generate(stage);
      constexpr double kReaches_m = 2e-3;  // a trunk bends until its legs just reach the ground
      EXPECT_LT(length(paw_m(*dog, motion, motion.frame_count - 1) - paw_m(*dog, motion, 0)), kReaches_m);
    }
}

TEST(LegReturns, ALegThatIsCutWithItsFootInTheGroundIsHeldOnTheGround) {
  const auto mech = stock("mech");
  InterruptDesc hit;
  hit.when.frame = 5;
  hit.sequence = sequence({blow("arm_right", 0, 30, 0.0)});
  Spec spec;
  spec.sequences = {sequence({use("reach", "leg_right", 0, 30, {{"target_m", Vec3(0.0, 1.0, -0.11)}})})};
  spec.interrupts = {hit};
  const Result<Stage> stage = build_stage(spec, mech);
  ASSERT_TRUE(stage) << to_line(stage.issue());
  EXPECT_EQ(broken_in(*stage), "");
  const Motion motion = generate(*stage);
  EXPECT_EQ(fixtures::coord(motion, 24, *mech, "leg_right/knee"), fixtures::coord(motion, 33, *mech, "leg_right/knee"));
}

// Legs do not fit a steep slope at rest. A foot that was in the ground before a blow returns to the same place.
TEST(LegReturns, AHitLegThatRestedInASteepSlopeRestsThereAgain) {
  Spec spec;
  spec.environment.ground = SlopeGround{.slope_deg = 25.0, .heading_deg = -120.0};
  spec.sequences = {sequence({blow("leg_left", 1, 30, 100.0)})};
  spec.hold_frames = 40;
  const Result<Stage> stage = build_stage(spec, fixtures::shared_human());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  const Motion motion = generate(*stage);
  for (std::size_t c = 0; c < motion.row(0).size(); ++c)
    EXPECT_EQ(motion.row(motion.frame_count - 1)[c], motion.row(0)[c]) << c;
}

// The room that a lifted foot has over the ground is none, which must not let the leg go on at full speed.
TEST(LegReturns, ALiftedLegSlowsDownBeforeTheOtherLeg) {
  const auto mech = stock("mech");
  for (const Vec3 target_m : {Vec3(0.0, 0.95, -0.16), Vec3(0.1, 0.6, 0.0)})
    EXPECT_EQ(broken_in(fixtures::stage_of({sequence({use("reach", "leg_right", 0, 30, {{"target_m", target_m}})})},
                                           10, mech)),
              "");
  // A foot that approaches low over the ground is lifted gradually.
  ActionUse faded = use("reach", "leg_right", 0, 33, {{"target_m", Vec3(0.0, 0.4, 0.5)}});
  faded.blend_out_frames = 13;
  EXPECT_EQ(broken_in(fixtures::stage_of({sequence({faded})}, 10, mech)), "");
  const ActionUse across = use("reach", "leg_right", 0, 30, {{"target_m", Vec3(0.33, 1.0, -0.27)}});
  EXPECT_EQ(broken_in(fixtures::stage_of({sequence({across, blow("foot_left", 30, 30, 0.0)})})), "");
}

TEST(LegReturns, ABendThatBlendsInWhileItGoesDownIsNoDeeperThanLegsCan) {
  for (const int in_frames : {6, 9, 16}) {
    ActionUse squat = use("squat", "waist", 0, 30, {{"lean_deg", 47.0}});
    squat.blend_in_frames = in_frames;
    EXPECT_EQ(broken_in(fixtures::stage_of({sequence({squat})})), "") << in_frames << " frames";
  }
}

// A bend that finds a foot in the air takes the time of that foot's way to come in, and goes down meanwhile.
TEST(LegReturns, ABendThatFindsAFootInTheAirIsNoDeeperThanTheStandingLegCan) {
  const auto mech = stock("mech");
  const auto broken = [&](const ActionUse& leg, int start_frame) {
    ActionUse squat = use("squat", "waist", start_frame, 30, {});
    squat.blend_in_frames = -1;
    return broken_in(fixtures::stage_of({sequence({leg, squat})}, 20, mech));
  };
  for (const int start_frame : {10, 14, 18, 20, 24, 28})
    EXPECT_EQ(broken(blow("leg_right", 0, 38, 0.0), start_frame), "") << "squat at " << start_frame;
  EXPECT_EQ(broken(use("reach", "leg_left", 0, 60, {{"target_m", Vec3(0.56, 1.0, -0.16)}}), 10), "");
}

// The heels of its fore paws rise in the crouch, so that they reach their places.
TEST(TrunkOverFeet, StopsWhereThePawsOfACrouchStillReach) {
  const ActionUse crouch = use("crouch", "hips", 0, 30, {{"back_m", -0.28}, {"lean_deg", -5.0}});
  const Stage stage = fixtures::stage_of({sequence({crouch, use("look_at", "trunk", 0, 30, {})})}, 0,
                                         stock("quadruped"));
  EXPECT_EQ(broken_in(stage), "");
}

// The trunk bent on in the frame in which the turn ended, and took the paws with it.
TEST(TrunkOverFeet, WaitsForPawsInTheFirstFrameAfterACourseToo) {
  const ActionUse look = use("look_at", "trunk", 21, 30, {{"target_m", Vec3(1.7, 1.5, 3.0)}});
  const Stage stage =
      fixtures::stage_of({sequence({use("turn", "hips", 0, 49, {}), look})}, 0, stock("quadruped"));
  EXPECT_EQ(broken_in(stage), "");
}

// A run that begins while a leg is lifted and the trunk rears up has paws that do not reach their places.
TEST(TrunkOverFeet, GoesNoFartherFromPawsThatDoNotReach) {
  const auto blended = [](ActionUse action) {
    action.blend_in_frames = ActionUse().blend_in_frames;
    return action;
  };
  const ActionUse rear = use("direction", "trunk", 0, 30, {{"elevation_deg", 10.0}});
  const Stage stage = fixtures::stage_of({sequence({blended(use("reach", "leg_fore_right", 0, 30, {})),
                                                    blended(use("run", "hips", 9, 30, {})), blended(rear)})},
                                         0, stock("quadruped"));
  EXPECT_EQ(broken_in(stage), "");
}

// Both legs move in the same frame. Each one kept its distance from the place where the other leg had been, but 29 of
// 96 such pairs of hits put a foot through the other one, most of them between two frames.
TEST(LegReturns, LegsThatAreHitTogetherDoNotPassThroughEachOther) {
  for (const double inward_deg : {-150.0, -110.0, -60.0, -30.0})
    for (const double other_deg : {30.0, 60.0, 110.0, 150.0})
      for (const int later : {0, 5, 10}) {
        std::vector<ActionUse> hits = {blow("leg_left", 0, 40, inward_deg), blow("foot_right", later, 40, other_deg)};
        for (ActionUse& hit : hits) hit.params["strength_deg"] = 50.0, hit.blend_in_frames = -1;
        EXPECT_EQ(broken_in(fixtures::stage_of({sequence(hits)}, 10, fixtures::shared_human())), "")
            << inward_deg << " " << other_deg << " " << later;
      }
}

// The foot passes the other one slowly. It was clear in both frames, and 3 mm deep in the other foot between them.
TEST(LegReturns, AFootThatGoesSlowlyIsClearBetweenFramesToo) {
  ActionUse reach = use("reach", "leg_left", 17, 62, {{"target_m", Vec3(-0.18, 1.42, -0.34)}, {"swivel_deg", 1.0}});
  reach.blend_in_frames = -1, reach.blend_out_frames = 12;
  EXPECT_EQ(broken_in(fixtures::stage_of({sequence({reach})}, 10, fixtures::shared_human())), "");
}

}  // namespace
}  // namespace contort
