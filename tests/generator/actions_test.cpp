// The promises of single actions, measured on the motion.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/stage_evaluator.h"
#include "generator/generate.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

// A character, and a motion of it with the world transforms of one frame.
class Played {
 public:
  Played(const CharacterChoice& choice, std::vector<ActionUse> actions, int hold = 0) {
    Spec spec;
    spec.character = choice;
    spec.sequences = {sequence(std::move(actions))};
    spec.hold_frames = hold;
    const Result<Stage> stage = build_stage(spec, stock_library());
    if (!stage) throw std::logic_error(to_line(stage.issue()));
    character = stage->character;
    motion = generate(*stage);
    world_.resize(character->joints().size());
  }
  Rigid socket(const std::string& name, int frame) {
    forward_kinematics(*character, motion.root[static_cast<std::size_t>(frame)], motion.row(frame), world_);
    return world_from_socket(*character, world_, character->find_socket(name));
  }
  double coord(const std::string& joint, int frame) const { return fixtures::coord(motion, frame, *character, joint); }
  std::shared_ptr<const Character> character;
  Motion motion;

 private:
  std::vector<Rigid> world_;
};

const CharacterChoice kRifleman{"human", {}, {{"rifle", "hand_right", "grip"}}};

TEST(Actions, WeaponHoldKeepsTheHandOnTheObjectWhileItsCarrierMoves) {
  Played played(kRifleman,
                {use("reach", "arm_right", 0, 40, {{"target_m", Vec3(-0.12, 1.28, 0.28)}}),
                 use("pose", "torso", 0, 60, {{"lumbar_rot_deg", 20.0}}), use("weapon_hold", "arm_left", 30, 60, {})});
  for (int f = 31; f <= 90; ++f) {
    const Vec3 gap_m = played.socket("hand_left/grip", f).p_m - played.socket("object:rifle/foregrip", f).p_m;
    EXPECT_LT(length(gap_m), 1e-3) << f;
  }
}

TEST(Actions, WeaponHoldFollowsAnArmThatComesLaterInTheOrderOfSlots) {
  // The left arm comes before the right one. The rifle is in the right hand and moves in every frame.
  Played played(kRifleman, {use("reach", "arm_right", 0, 60, {{"target_m", Vec3(-0.12, 1.28, 0.28)}}),
                            use("weapon_hold", "arm_left", 40, 20, {})});
  for (int f = 42; f <= 60; ++f) {
    const Vec3 gap_m = played.socket("hand_left/grip", f).p_m - played.socket("object:rifle/foregrip", f).p_m;
    EXPECT_LT(length(gap_m), 1e-3) << f;
  }
}

TEST(Actions, TwoArmsCannotEachHoldWhatTheOtherCarries) {
  Spec spec;
  spec.character = kRifleman;
  spec.sequences = {sequence({use("weapon_hold", "arm_right", 0, 30, {})})};
  EXPECT_EQ(build_stage(spec, stock_library()).issue().code, "spec.unsupported_action") << "its own hand carries it";
  spec.sequences = {sequence({use("weapon_hold", "arm_left", 0, 30, {{"point", std::string("trigger")}})})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_FALSE(stage.ok());
  EXPECT_EQ(stage.issue().code, "spec.unknown_point");
  EXPECT_EQ(stage.issue().pointer, "/sequences/0/clips/0/actions/0/params/point");
}

TEST(Actions, HoldingInACircleIsRefused) {
  Library library = stock_library();
  ObjectDesc second = library.objects.at("rifle");
  second.name = "rifle_two";
  library.objects["rifle_two"] = second;
  library.characters.at("human").objects.push_back("rifle_two");
  Spec spec;
  spec.character = {"human", {}, {{"rifle", "hand_right", "grip"}, {"rifle_two", "hand_left", "grip"}}};
  spec.sequences = {sequence({use("weapon_hold", "arm_left", 0, 30, {})})};
  EXPECT_TRUE(build_stage(spec, library).ok());
  spec.sequences[0].clips[0].actions.push_back(use("weapon_hold", "arm_right", 0, 30, {}));
  const Result<Stage> stage = build_stage(spec, library);
  ASSERT_FALSE(stage.ok());
  EXPECT_EQ(stage.issue().code, "spec.circular_hold");
}

TEST(Actions, RecoilLiftsTheArmAndLeavesNothing) {
  Played played({},
                {use("pose", "arm_left", 0, 10, {{"shoulder_deg", Vec3(-80, 0, 0)}, {"elbow_deg", 20.0}}),
                 use("recoil", "arm_left", 20, 20, {{"rise_deg", 10.0}, {"bend_deg", 12.0}})},
                5);
  const double before_m = played.socket("arm_left/wrist", 20).p_m.y;
  EXPECT_GT(played.socket("arm_left/wrist", 25).p_m.y, before_m + 0.05);
  EXPECT_NEAR(played.coord("arm_left/elbow", 25), 32 * kRadPerDeg, 1e-12);
  for (int f = 40; f < 46; ++f) EXPECT_EQ(played.coord("arm_left/elbow", f), 20 * kRadPerDeg);
}

TEST(Actions, ExtendMovesTravelsAndNothingElse) {
  const CharacterChoice mech{"mech", {{"arm_left", "mech_arm_extend"}}, {}};
  Played played(mech, {use("extend", "arm_left", 0, 20, {{"share", 0.5}})});
  const Joint& travel = fixtures::joint(*played.character, "arm_left/extend");
  EXPECT_DOUBLE_EQ(played.coord("arm_left/extend", 20), 0.5 * (travel.low + travel.high));
  EXPECT_EQ(played.coord("arm_left/elbow", 20), 0.0);
}

TEST(Actions, LookAtFacesItsPointWhileTheBodyTurns) {
  const Vec3 point_m(0.8, 1.5, 1.0);
  Played played({}, {use("look_at", "head", 0, 60, {{"target_m", point_m}}),
                     use("pose", "torso", 0, 60, {{"lumbar_rot_deg", 30.0}, {"lumbar_flex_deg", 20.0}})});
  const std::string eyes =
      played.character
          ->sockets()[static_cast<std::size_t>(
              played.character->parts()[static_cast<std::size_t>(played.character->find_part("head"))]
                  .facing.front()
                  .socket)]
          .name;
  for (int f = 1; f <= 60; ++f) {
    const Rigid world_from_eyes = played.socket(eyes, f);
    const Vec3 towards = unit_or(point_m - world_from_eyes.p_m, Vec3(0.0));
    const double cosine = glm::dot(world_from_eyes.q * Vec3(0, 0, 1), towards);
    EXPECT_GT(cosine, std::cos(0.1 * kRadPerDeg)) << f;
  }
}

// Many postures face a direction. Solving one joint after another once gave a posture that tilts the head by 40
// degrees.
TEST(Actions, ADirectionTakesTheSmallestAngles) {
  Played played({}, {use("direction", "head", 0, 40, {{"azimuth_deg", 30.0}, {"elevation_deg", 15.0}})});
  double tilt_rad = 0.0, all_rad = 0.0;
  for (const char* joint : {"neck_flex", "neck_lat", "neck_rot"}) {
    const double angle = std::fabs(played.coord("head/" + std::string(joint), 40));
    all_rad += angle;
    if (std::string_view(joint).ends_with("_lat")) tilt_rad += angle;
  }
  EXPECT_LT(tilt_rad, 8 * kRadPerDeg);
  EXPECT_LT(all_rad, 65 * kRadPerDeg);
  EXPECT_GT(all_rad, 40 * kRadPerDeg) << "it turns by 30 and rises by 15";
}

// A lean leaves the hips behind the feet. The walk once began half a metre beside the figure.
TEST(Actions, AWalkAfterALeanBeginsWhereTheFigureStands) {
  ActionUse walk = use("walk", "waist", 0, 120, {{"speed_m_s", 0.6}});
  walk.blend_in_frames = 25;
  Spec spec;
  spec.sequences = {sequence({use("crouch", "waist", 0, 40, {{"share", 0.3}, {"lean_deg", 40.0}, {"back_m", 0.2}})}),
                    sequence({walk})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  StageEvaluator evaluator;
  for (const Finding& finding : evaluator.run(*stage).findings)
    EXPECT_FALSE(finding.check == "foot_slide" || finding.check == "pop") << finding.subject << finding.first_frame;
  const Motion& motion = evaluator.motion();
  for (std::size_t f = 1; f < motion.root.size(); ++f) {
    const Vec3 step = motion.root[f].p_m - motion.root[f - 1].p_m;
    EXPECT_LT(std::hypot(step.x, step.z), 0.03) << "frame " << f;
  }
}

// The rifle points at a fixed place while the body walks and turns under it.
TEST(Actions, AimPointsTheMuzzleAtItsTarget) {
  const Vec3 target_m(-2.0, 1.4, 8.0);
  Played played(
      kRifleman,
      {use("walk", "waist", 0, 200, {{"speed_m_s", 1.0}}), use("pose", "torso", 0, 200, {{"lumbar_rot_deg", 15.0}}),
       use("aim", "arm_right", 0, 200, {{"point", std::string("muzzle")}, {"target_m", target_m}})});
  const Part& arm = played.character->parts()[static_cast<std::size_t>(played.character->find_part("arm_right"))];
  ASSERT_GT(arm.joint_count, 0);
  for (int f = 1; f <= 200; ++f) {
    const Rigid world_from_muzzle = played.socket("object:rifle/muzzle", f);
    const double cosine =
        glm::dot(world_from_muzzle.q * Vec3(0, 0, 1), unit_or(target_m - world_from_muzzle.p_m, Vec3(0.0)));
    ASSERT_GT(cosine, std::cos(0.1 * kRadPerDeg)) << f;
  }
  StageEvaluator evaluator;
  for (const Finding& finding : evaluator.judge(*played.character, played.motion, "joint_range"))
    EXPECT_EQ(finding.subject.find("arm_right"), std::string::npos) << finding.subject;
}

TEST(Actions, TouchFindsTheWallWhileWalkingAndTellsOfTheContact) {
  Spec spec;
  spec.environment.obstacles = {{"wall", Box{Vec3(0.55, 1.0, 4.0), Vec3(0.1, 1.0, 3.0), Vec3(0.0)}}};
  spec.sequences = {
      sequence({use("walk", "waist", 0, 300, {{"speed_m_s", 0.8}}), use("touch", "arm_left", 60, 200, {})})};
  InterruptDesc on_contact;
  on_contact.when.event = Event::contact;
  on_contact.when.slot = "arm_left";
  on_contact.enter = Enter::end;
  on_contact.sequence = sequence({use("squat", "waist", 0, 30, {})});
  spec.interrupts = {on_contact};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage.ok());
  const Motion motion = generate(*stage);
  EXPECT_EQ(motion.queue.size(), 2U) << "no contact was told";
  std::vector<Rigid> world(stage->character->joints().size());
  int touching = 0, turned = 0;
  for (int f = 150; f <= 250; ++f) {
    forward_kinematics(*stage->character, motion.root[static_cast<std::size_t>(f)], motion.row(f), world);
    const Vec3 grip = world_from_socket(*stage->character, world, stage->character->find_socket("hand_left/grip")).p_m;
    const double gap_m = stage->environment.nearest_obstacle(grip).distance_m;
    touching += gap_m > 0.029 && gap_m < 0.06;  // a wrist that cannot bend far enough has a greater gap
    const Vec3 palm =
        world_from_socket(*stage->character, world, stage->character->find_socket("hand_left/grip")).q * Vec3(0, 0, 1);
    turned += palm.x > 0.5;  // towards the wall at the left; 0.18 with the wrist at rest, 0.63 at the limit of this arm
  }
  EXPECT_EQ(touching, 101);
  EXPECT_EQ(turned, 101);
  // The hand that touches the wall does not enter it, and neither does the arm that swings with the walk afterwards.
  EXPECT_TRUE(StageEvaluator().run(*stage, "obstacle_penetration").findings.empty());
}

std::vector<Finding> enters_wall(const ActionUse& action, const Vec3& center_m) {
  Spec spec;
  spec.environment.obstacles = {{"wall", Box{center_m, Vec3(0.1, 1.0, 3.0), Vec3(0.0)}}};
  spec.sequences = {sequence({action})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return StageEvaluator().run(*stage, "obstacle_penetration").findings;
}

TEST(Actions, ArmsThatSwingBesideAWallKeepClearOfIt) {
  for (const double gap_m : {0.27, 0.3, 0.33})
    EXPECT_TRUE(enters_wall(use("run", "waist", 0, 90, {}), Vec3(-gap_m - 0.1, 1.0, 2.0)).empty()) << gap_m;
}

TEST(Actions, LegsThatReachBesideAWallKeepClearOfIt) {
  for (const double aside_m : {0.3, 0.4, 0.55}) {
    const ActionUse reach = use("reach", "leg_right", 0, 40, {{"target_m", Vec3(-aside_m, 0.7, 0.3)}});
    EXPECT_TRUE(enters_wall(reach, Vec3(-0.5, 1.0, 0.0)).empty()) << aside_m;
  }
}

TEST(Actions, AnImpactFiresItsInterrupt) {
  Spec spec;
  spec.sequences = {sequence({use("hit_reaction", "torso", 10, 30, {})})};
  InterruptDesc on_impact;
  on_impact.when.event = Event::impact;
  on_impact.sequence = sequence({use("pose", "arm_left", 0, 10, {{"elbow_deg", 40.0}})});
  spec.interrupts = {on_impact};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage.ok());
  EXPECT_EQ(generate(*stage).queue, (std::vector<QueueSpan>{{0, 11, 0, 0}, {11, 21, 1, 0}, {21, 50, 0, 11}}));
}

}  // namespace
}  // namespace contort
