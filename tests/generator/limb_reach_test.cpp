// The choices of reach and weapon_hold: the swivel that is left open, travels, and the room of a limb's bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "generator/execute.h"
#include "generator/motion/limb_room.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

Spec reaching(const CharacterChoice& character, const Vec3& target_m, const ParamValue* swivel_deg) {
  ActionUse reach = use("reach", "arm_left", 0, 60, {{"target_m", target_m}});
  if (swivel_deg != nullptr) reach.params["swivel_deg"] = *swivel_deg;
  Spec spec;
  spec.character = character;
  spec.hold_frames = 10;
  spec.sequences = {sequence({reach})};
  return spec;
}

int findings_of(const Spec& spec, Intent* intent = nullptr) {
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) ADD_FAILURE() << to_line(stage.issue());
  StageEvaluator evaluator;
  const Evaluation evaluation = evaluator.run(*stage);
  if (intent != nullptr) *intent = *evaluator.execution().intent;
  return static_cast<int>(evaluation.findings.size());
}

// Points in front of the left shoulder, which is at (0.2, 1.4, 0), within the length of the arm.
std::vector<Vec3> points_in_front() {
  std::vector<Vec3> points;
  for (const double x : {-0.1, 0.1, 0.3})
    for (const double y : {1.0, 1.2, 1.4, 1.6})
      for (const double z : {0.2, 0.3, 0.4})
        if (length(Vec3(x - 0.2, y - 1.4, z)) < 0.5) points.emplace_back(x, y, z);
  return points;
}

TEST(LimbReach, ASwivelIsTakenAsFarAsJointsAndBodiesAllow) {
  for (const double swivel_deg : {-150.0, -60.0, 0.0, 60.0, 150.0}) {
    const ParamValue wish = swivel_deg;
    int found = 0;
    for (const Vec3& point : points_in_front()) found += findings_of(reaching({"human", {}, {}}, point, &wish)) > 0;
    EXPECT_LE(found, 1) << swivel_deg;
  }
}

TEST(LimbReach, AnOpenSwivelFindsAWayToo) {
  int found = 0;
  for (const Vec3& point : points_in_front()) found += findings_of(reaching({"human", {}, {}}, point, nullptr)) > 0;
  EXPECT_LE(found, 1);
}

// Behind and above the hand the elbow has room on all sides.
TEST(LimbReach, ASwivelThatIsPossibleIsTakenAsItIs) {
  const auto elbow_m = [](double swivel_deg) {
    const ParamValue wish = swivel_deg;
    const Result<Stage> stage = build_stage(reaching({"human", {}, {}}, Vec3(0.35, 1.35, 0.4), &wish), stock_library());
    const Motion motion = generate(*stage);
    std::vector<Rigid> world(stage->character->joints().size());
    forward_kinematics(*stage->character, motion.root[60], motion.row(60), world);
    return world[static_cast<std::size_t>(stage->character->find_joint("arm_left/elbow"))].p_m;
  };
  EXPECT_GT(length(elbow_m(0.0) - elbow_m(20.0)), 0.05);
  EXPECT_LT(elbow_m(0.0).y, 1.3) << "it hangs straight down";
}

TEST(LimbReach, TravelsGoOutWhereTheArmIsTooShort) {
  const CharacterChoice mech{"mech", {{"arm_left", "mech_arm_extend"}}, {}};
  Spec spec = reaching(mech, Vec3(1.3, 1.6, 0.5), nullptr);
  spec.sequences[0].clips[0].actions[0].duration_frames = 100;  // travels are slow
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  const Motion motion = generate(*stage);
  const double travel_m = fixtures::coord(motion, 100, *stage->character, "arm_left/extend");
  EXPECT_GT(travel_m, 0.01);
  EXPECT_LE(travel_m, fixtures::joint(*stage->character, "arm_left/extend").high);
  const Intent intent = intent_of(*stage);
  ASSERT_EQ(intent.goals.size(), 1U);
  std::vector<Rigid> world(stage->character->joints().size());
  forward_kinematics(*stage->character, motion.root[100], motion.row(100), world);
  const Vec3 tip_m = world_from_socket(*stage->character, world, intent.goals[0].socket).p_m;
  EXPECT_LT(length(tip_m - Vec3(1.3, 1.6, 0.5)), 1e-3);
}

TEST(LimbReach, TravelsStayWhereTheArmIsLongEnough) {
  const CharacterChoice mech{"mech", {{"arm_left", "mech_arm_extend"}}, {}};
  const Result<Stage> stage = build_stage(reaching(mech, Vec3(0.5, 1.4, 0.4), nullptr), stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  const Motion motion = generate(*stage);
  const auto coord = static_cast<std::size_t>(fixtures::joint(*stage->character, "arm_left/extend").coord);
  EXPECT_EQ(motion.row(60)[coord], stage->character->rest_coords()[coord]);
}

TEST(LimbReach, TravelsDoNotGoOutForATargetThatIsTooNear) {
  const CharacterChoice mech{"mech", {{"arm_left", "mech_arm_extend"}}, {}};
  const Result<Character> character = build_character(mech, stock_library());
  ASSERT_TRUE(character);
  std::vector<Rigid> world(character->joints().size());
  forward_kinematics(*character, character->rest_root(), character->rest_coords(), world);
  const int upper = character->parts()[static_cast<std::size_t>(character->find_part("arm_left"))].reach.front().upper;
  const Vec3 near_m = world[static_cast<std::size_t>(upper)].p_m + Vec3(0.02, 0.0, 0.03);
  const Result<Stage> stage = build_stage(reaching(mech, near_m, nullptr), stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  const Motion motion = generate(*stage);
  const auto coord = static_cast<std::size_t>(fixtures::joint(*stage->character, "arm_left/extend").coord);
  EXPECT_EQ(motion.row(60)[coord], stage->character->rest_coords()[coord]);
}

TEST(LimbReach, TargetsThatEvenTravelsDoNotReachAreUnmet) {
  const CharacterChoice mech{"mech", {{"arm_left", "mech_arm_extend"}}, {}};
  Intent intent;
  findings_of(reaching(mech, Vec3(3.0, 1.6, 0.5), nullptr), &intent);
  ASSERT_EQ(intent.unmet.size(), 1U);
  EXPECT_EQ(intent.unmet[0].action, "reach");
}

TEST(LimbRoom, ALimbIsAChainOfPartsUpToABranch) {
  const Result<Character> human = build_character({"human", {}, {}}, stock_library());
  ASSERT_TRUE(human);
  const auto slots = [&](const contort::Limb& limb) {
    std::vector<std::string> names;
    for (const int part : limb.parts) names.push_back(human->parts()[static_cast<std::size_t>(part)].slot);
    return names;
  };
  std::size_t parts = 0;
  bool has_arm = false;
  for (const contort::Limb& limb : limbs_of(*human, {})) {
    parts += limb.parts.size();
    has_arm = has_arm || slots(limb) == std::vector<std::string>{"arm_left", "hand_left"};
  }
  EXPECT_EQ(parts, human->parts().size() - 1) << "each part but the root part is in one limb";
  EXPECT_TRUE(has_arm);
}

// A figure on level ground none of whose feet was seen to stand.
struct RestingRoom {
  explicit RestingRoom(const Character& character) { begin(character); }
  void begin(const Character& character) { room.begin(character, level, feet); }

  Environment level;
  StandingFeet feet;
  LimbRoom room;
};

TEST(LimbRoom, IsNegativeWhereBodiesOverlapAndNeverAtRest) {
  const Result<Character> human = build_character({"human", {}, {}}, stock_library());
  ASSERT_TRUE(human);
  std::vector<double> coords(human->rest_coords().begin(), human->rest_coords().end());
  std::vector<Rigid> world(human->joints().size());
  const auto arm = static_cast<std::size_t>(human->find_part("arm_left"));
  RestingRoom begun(*human);
  LimbRoom& room = begun.room;
  forward_kinematics(*human, human->rest_root(), coords, world);
  room.begin_frame(world);
  EXPECT_GE(room.room_m(arm, world), 0.0);
  const Joint& shoulder = fixtures::joint(*human, "arm_left/shoulder");
  const Quat inward = axis_angle(Vec3(0, 0, 1), -40 * kRadPerDeg);
  const Quat was(coords[at(shoulder.coord)], coords[at(shoulder.coord + 1)], coords[at(shoulder.coord + 2)],
                 coords[at(shoulder.coord + 3)]);
  const Quat turned = was * inward;
  coords[at(shoulder.coord)] = turned.w, coords[at(shoulder.coord + 1)] = turned.x;
  coords[at(shoulder.coord + 2)] = turned.y, coords[at(shoulder.coord + 3)] = turned.z;
  forward_kinematics(*human, human->rest_root(), coords, world);
  EXPECT_LT(room.room_m(arm, world), 0.0) << "the arm is in the trunk";
}

// A hand on the foregrip overlaps the rifle: it may, as long as it holds it, and not in a motion made after that.
TEST(LimbRoom, AHandMayTouchWhatItHoldsUntilTheNextMotion) {
  Spec spec;
  spec.character.attachments = {{"rifle", "hand_right", "grip"}};
  spec.sequences = {sequence({use("reach", "arm_right", 0, 40, {{"target_m", Vec3(-0.12, 1.28, 0.28)}}),
                              use("weapon_hold", "arm_left", 40, 20, {})})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  const Character& human = *stage->character;
  const Motion motion = generate(*stage);
  std::vector<Rigid> world(human.joints().size());
  forward_kinematics(human, motion.root[60], motion.row(60), world);
  const auto arm = static_cast<std::size_t>(human.find_part("arm_left"));
  RestingRoom begun(human);
  LimbRoom& room = begun.room;
  room.begin_frame(world);
  EXPECT_LT(room.room_m(arm, world), -kTooNear_m);
  const int hand = human.sockets()[static_cast<std::size_t>(human.find_socket("hand_left/grip"))].joint;
  const auto rifle = std::ranges::find(human.bodies(), "object:rifle", &Body::name) - human.bodies().begin();
  const HeldObject held{hand, static_cast<int>(rifle)};
  EXPECT_TRUE(room.is_at(held, arm, world));
  room.hold(arm, held);
  EXPECT_GT(room.room_m(arm, world), 0.0);
  begun.begin(human);
  EXPECT_LT(room.room_m(arm, world), -kTooNear_m);
}

// On a hill, beside a box: bodies come near each other, the ground and the box in turn.
EnvironmentDesc hill_with_box() {
  EnvironmentDesc desc;
  HeightGround hill;
  hill.columns = 3, hill.rows = 3, hill.spacing_m = 0.8;
  hill.heights_m = {0.0, 0.2, 0.0, 0.1, 0.3, 0.4, 0.0, 0.1, 0.0};
  desc.ground = hill;
  desc.obstacles = {{"box", Box{Vec3(0.5, 1.0, 0.2), Vec3(0.2, 0.3, 0.2), Vec3(0.0)}}};
  return desc;
}

TEST(LimbRoom, ANarrowRangeTellsTheSameWithinIt) {
  const Result<Character> human = build_character({"human", {}, {}}, stock_library());
  const Result<Environment> environment = build_environment(hill_with_box());
  ASSERT_TRUE(human && environment);
  StandingFeet feet;
  LimbRoom room;
  room.begin(*human, *environment, feet);
  std::vector<double> coords(human->rest_coords().begin(), human->rest_coords().end());
  std::vector<Rigid> world(human->joints().size());
  std::mt19937_64 random(4);
  int below = 0, within = 0, above = 0;
  for (int round = 0; round < 300; ++round) {
    for (const Joint& joint : human->joints())
      if (joint.kind == JointKind::hinge)
        coords[at(joint.coord)] = std::uniform_real_distribution(joint.low, joint.high)(random);
    Rigid root = human->rest_root();
    root.p_m.y += std::uniform_real_distribution(-0.1, 0.6)(random);
    forward_kinematics(*human, root, coords, world);
    room.begin_frame(world);
    for (const Limb& limb : room.limbs()) {
      const std::size_t part = at(limb.parts.back());
      const double whole_m = room.room_m(part, world), low_m = -0.01, high_m = 0.02;
      const double told_m = room.room_m(part, world, {low_m, high_m});
      EXPECT_EQ(room.has_room(part, world, 0.005), whole_m >= 0.005);
      ++(whole_m < low_m ? below : whole_m < high_m ? within : above);
      if (whole_m < low_m) {
        EXPECT_LT(told_m, low_m);
      } else {
        EXPECT_EQ(told_m, std::min(whole_m, high_m));
      }
    }
  }
  EXPECT_GT(std::min({below, within, above}), 20) << below << " " << within << " " << above;
}

}  // namespace
}  // namespace contort
