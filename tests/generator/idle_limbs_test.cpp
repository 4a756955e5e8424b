// Limbs that no action moves make way for bodies that come towards them, and limbs that bodies have stopped come back.
#include <gtest/gtest.h>

#include <algorithm>

#include "generator/execute.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

Stage scene(const char* character, std::vector<ActionUse> actions, int hold_frames, double wall_x_m = 0.0) {
  Spec spec;
  spec.character.name = character;
  spec.hold_frames = hold_frames;
  spec.sequences = {sequence(std::move(actions))};
  if (wall_x_m != 0.0)
    spec.environment.obstacles = {{"wall", Box{.center_m = Vec3(wall_x_m, 1.0, 1.0), .half_m = Vec3(0.1, 1.0, 2.0)}}};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return *stage;
}

double angle_rad(const Stage& stage, const Motion& motion, int frame, const char* joint) {
  const int coord = stage.character->joint(stage.character->find_joint(joint)).coord;
  return motion.row(frame)[static_cast<std::size_t>(coord)];
}

// Its way back led past the thigh with less than the comfortable gap, and it stayed where it was for good.
TEST(IdleLimbs, AnArmThatABlowHasSwungBesideTheHipComesBack) {
  const ActionUse blow = use("hit_reaction", "arm_right", 1, 30, {{"azimuth_deg", 53.0}, {"strength_deg", 50.0}});
  const Stage stage = scene("mech", {blow}, 40);
  EXPECT_EQ(broken_in(stage), "");
  const Motion motion = generate(stage);
  EXPECT_GT(angle_rad(stage, motion, 8, "arm_right/elbow"), 0.1);
  EXPECT_EQ(angle_rad(stage, motion, motion.frame_count - 1, "arm_right/elbow"),
            angle_rad(stage, motion, 0, "arm_right/elbow"));
}

TEST(IdleLimbs, AHangingArmMakesWayForAThighWhenTheTrunkTurns) {
  const ActionUse turn = use("pose", "torso", 30, 30, {{"lumbar_rot_deg", 11.0}});
  EXPECT_EQ(broken_in(scene("human", {use("reach", "leg_right", 0, 30, {}), turn}, 10)), "");
}

TEST(IdleLimbs, ATailMakesWayForAWallWhenTheHipsTurn) {
  const Stage stage = scene("quadruped", {use("turn", "hips", 0, 85, {})}, 0, -0.41);
  EXPECT_EQ(broken_in(stage), "");
}

// An author's pose is taken as it is.
TEST(IdleLimbs, AHandThatAPoseHasPutIntoTheThighStaysThere) {
  const ActionUse pose = use("pose", "hand_left", 0, 20, {{"wrist_dev_deg", -19.0}});
  const Stage stage = scene("human", {pose, use("pose", "head", 30, 20, {{"neck_flex_deg", 10.0}})}, 20);
  EXPECT_NE(broken_in(stage), "");
  const Motion motion = generate(stage);
  EXPECT_NEAR(angle_rad(stage, motion, motion.frame_count - 1, "hand_left/wrist_dev"), -19.0 * kRadPerDeg, 1e-12);
}

// The pose turns the shoulder alone. With the elbow that the reach leaves bent, the hand went 2.5 cm into the thigh.
TEST(IdleLimbs, AnArmThatIsPosedAfterAReachMakesWayForBodies) {
  ActionUse reach = use("reach", "arm_right", 0, 30, {});
  reach.blend_in_frames = reach.blend_out_frames = ActionUse().blend_in_frames;
  const ActionUse pose = use("pose", "arm_right", 0, 36, {{"shoulder_deg", Vec3(13.0, 0.0, 0.0)}});
  const Stage stage = scene("human", {pose, reach}, 30);
  EXPECT_EQ(broken_in(stage), "");
  const std::vector<UnmetRequest> unmet = intent_of(stage).unmet;
  EXPECT_TRUE(std::ranges::any_of(unmet, [](const UnmetRequest& one) { return one.why == Shortfall::clearance; }));
}

// The trunk leans to the side and keeps the hand near the thigh; the wrist's pose alone has room. The hand went 2.5 cm
// into the thigh.
TEST(IdleLimbs, AHandInAPoseMakesWayForTheThighThatATrunkCarriesItTo) {
  ActionUse pose = use("pose", "hand_right", 21, 85, {{"wrist_flex_deg", -26.0}, {"wrist_dev_deg", -13.0}});
  ActionUse lean = use("direction", "torso", 13, 23, {{"azimuth_deg", 153.0}, {"elevation_deg", 46.0}});
  pose.blend_in_frames = lean.blend_in_frames = ActionUse().blend_in_frames;
  lean.speed = 0.5;
  const Stage stage = scene("human", {pose, lean}, 10);
  EXPECT_EQ(broken_in(stage), "");
  EXPECT_EQ(broken_in(scene("human", {pose}, 10)), "");
  EXPECT_TRUE(intent_of(scene("human", {pose}, 10)).unmet.empty());
}

// A wall takes the room of the pose as a trunk would.
TEST(IdleLimbs, AnArmInAPoseStopsAtAWall) {
  ActionUse pose = use("pose", "arm_left", 0, 60, {{"shoulder_deg", Vec3(0.0, 0.0, 60.0)}});
  pose.blend_in_frames = ActionUse().blend_in_frames;
  EXPECT_EQ(broken_in(scene("human", {pose}, 10)), "");
  const Stage stage = scene("human", {pose}, 10, 0.6);
  EXPECT_EQ(broken_in(stage), "");
  const std::vector<UnmetRequest> unmet = intent_of(stage).unmet;
  EXPECT_TRUE(std::ranges::any_of(unmet, [](const UnmetRequest& one) { return one.why == Shortfall::clearance; }));
}

}  // namespace
}  // namespace contort
