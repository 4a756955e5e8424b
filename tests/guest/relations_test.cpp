// Requests and motions of the other side, and requests that are nearly the same.
#include "guest/relations.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "guest/guest_figure.h"
#include "guest/guest_offers.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {
namespace {

Quat any_rotation() {
  const auto part = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  return glm::normalize(Quat(1.001 + part(), part(), part(), part()));
}

GuestJoint joint_named(const std::string& name, const std::string& parent, const Vec3& position, const Quat& rotation) {
  GuestJoint joint;
  joint.name = name, joint.parent = parent, joint.position = position;
  joint.rotation = {rotation.x, rotation.y, rotation.z, rotation.w};
  return joint;
}

// Arms that are each other's mirror image at rest, although the frames of their joints are not.
GuestManifest two_armed(const Quat& left, const Quat& right) {
  GuestCharacter hero;
  hero.name = "hero";
  hero.joints = {joint_named("hips", "", Vec3(0.0, 1.0, 0.0), kNoRotation),
                 joint_named("arm_l", "hips", Vec3(0.2, 0.4, 0.0), left),
                 joint_named("hand_l", "arm_l", glm::conjugate(left) * Vec3(0.3, -0.1, 0.2), kNoRotation),
                 joint_named("arm_r", "hips", Vec3(-0.2, 0.4, 0.0), right),
                 joint_named("hand_r", "arm_r", glm::conjugate(right) * Vec3(-0.3, -0.1, 0.2), kNoRotation)};
  hero.joints[1].slot = "left", hero.joints[3].slot = "right";
  hero.mirror = {{"arm_l", "arm_r"}, {"hand_l", "hand_r"}};
  GuestManifest manifest;
  manifest.contort = 1, manifest.name = "g", manifest.characters = {hero};
  manifest.relations = {"mirror"};
  return manifest;
}

GuestAction action_with(const std::string& name, const std::map<std::string, GuestParam>& params) {
  GuestAction action;
  action.name = name, action.slots = {"left", "right"}, action.params = params;
  return action;
}

RC_GTEST_PROP(GuestRelations, MirrorImagesPlaceEachJointWhereItsPartnerIsReflected, ()) {
  const GuestManifest manifest = two_armed(any_rotation(), any_rotation());
  const Library library = library_of(manifest);
  const Character character = build_character({"hero", {}, {}}, library).value();
  const std::vector<int> joints = joints_of(manifest.characters[0], character);
  Motion motion;
  motion.frame_count = 1, motion.coord_count = character.coord_count();
  motion.coords.resize(at(motion.coord_count));
  motion.root = {{any_rotation(), Vec3(0.3, 1.1, -0.2)}};
  double unused = 0.0;
  for (std::size_t j = 1; j < character.joints().size(); ++j)
    set_rotation(character.joints()[j], any_rotation(), 0, motion, unused);
  const FrameLayout layout{character, joints, Basis({}), FrameFormat::f64};
  const Motion image = mirror_image(manifest.characters[0], root_at_rest(manifest, "hero"), layout, motion);
  std::vector<Rigid> world(joints.size()), reflected(joints.size());
  forward_kinematics(character, motion.root[0], motion.row(0), world);
  forward_kinematics(character, image.root[0], image.row(0), reflected);
  const std::vector<std::size_t> partners = partners_of(manifest.characters[0]);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Vec3 other = world[at(joints[partners[j]])].p_m;
    RC_ASSERT(length(reflected[at(joints[j])].p_m - Vec3(-other.x, other.y, other.z)) < 1e-9);
  }
}

struct Asked {
  GuestManifest manifest = two_armed(kNoRotation, kNoRotation);
  Library library{};
  std::optional<Character> character{};
  Offers offers{};
  Spec spec{};
};

// One use of the first action on the left side.
Asked asked_with(std::vector<GuestAction> actions, const std::map<std::string, ParamValue>& params) {
  Asked asked;
  asked.manifest.actions = std::move(actions);
  asked.library = library_of(asked.manifest);
  asked.character = build_character({"hero", {}, {}}, asked.library).value();
  asked.offers = offers_of(asked.manifest, *asked.character);
  ActionUse use;
  use.action = asked.manifest.actions[0].name, use.slot = "left", use.duration_frames = 30, use.params = params;
  asked.spec.character.name = "hero";
  asked.spec.sequences.push_back({"", 0, {{}}});
  asked.spec.sequences[0].clips[0].actions = {use};
  return asked;
}

std::vector<PlacedUse> uses_of(const Asked& asked) {
  return placed_uses(asked.manifest, asked.spec, *asked.character, asked.offers);
}

std::optional<Spec> other_side(const Asked& asked) {
  return mirrored(asked.manifest, asked.spec, uses_of(asked), *asked.character, asked.offers);
}

GuestParam param_of(GuestParamType type, double low, double high, OtherSide mirror = OtherSide::by_type) {
  GuestParam param;
  param.type = type, param.low = low, param.high = high, param.mirror = mirror;
  return param;
}

TEST(GuestRelations, TheOtherSideHasItsSlotActionAndReflectedPoints) {
  GuestAction left = action_with("wave_left", {{"to", param_of(GuestParamType::vec3, -2, 2)},
                                               {"turn", param_of(GuestParamType::number, -9, 9, OtherSide::opposite)},
                                               {"size", param_of(GuestParamType::number, 0, 9)}});
  left.mirror = "wave_right";
  GuestAction right = left;
  right.name = "wave_right", right.mirror = "wave_left";
  const Asked asked = asked_with({left, right}, {{"to", Vec3(1.0, 0.5, 0.2)}, {"turn", 3.0}, {"size", 4.0}});
  const std::optional<Spec> other = other_side(asked);
  ASSERT_TRUE(other);
  const ActionUse& use = other->sequences[0].clips[0].actions[0];
  EXPECT_EQ(use.action, "wave_right");
  EXPECT_EQ(use.slot, "right");
  EXPECT_EQ(std::get<Vec3>(use.params.at("to")), Vec3(-1.0, 0.5, 0.2));
  EXPECT_EQ(std::get<double>(use.params.at("turn")), -3.0);
  EXPECT_EQ(std::get<double>(use.params.at("size")), 4.0);
}

TEST(GuestRelations, ARequestWhoseReflectionIsNotOfferedHasNoOtherSide) {
  const auto turn = param_of(GuestParamType::number, -1, 9, OtherSide::opposite);
  EXPECT_TRUE(other_side(asked_with({action_with("wave", {{"turn", turn}})}, {{"turn", 1.0}})));
  EXPECT_FALSE(other_side(asked_with({action_with("wave", {{"turn", turn}})}, {{"turn", 3.0}})));
  GuestAction one_armed = action_with("wave", {});
  one_armed.slots = {"left"};
  EXPECT_FALSE(other_side(asked_with({one_armed}, {})));
}

TEST(GuestRelations, ANudgeMovesWhatIsContinuousAndStaysInRange) {
  const Asked asked = asked_with({action_with("wave", {{"to", param_of(GuestParamType::vec3, 0, 10)},
                                                       {"count", param_of(GuestParamType::integer, 0, 10)},
                                                       {"turn", param_of(GuestParamType::number, 0, 10)}})},
                                 {{"to", Vec3(10.0, 0.0, 2.0)}, {"count", 4.0}});
  const Spec near = nudged(asked.spec, uses_of(asked));
  const ActionUse& use = near.sequences[0].clips[0].actions[0];
  const Vec3 to = std::get<Vec3>(use.params.at("to"));
  EXPECT_LT(length(to - Vec3(9.999, 0.001, 2.001)), 1e-12);
  EXPECT_EQ(std::get<double>(use.params.at("count")), 4.0);
  EXPECT_NEAR(std::get<double>(use.params.at("turn")), 0.001, 1e-12) << "from its default, 0";
}

}  // namespace
}  // namespace contort
