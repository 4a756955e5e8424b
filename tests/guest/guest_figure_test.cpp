// Characters of manifests: names, shapes, and the pairs of shapes that are judged.
#include "guest/guest_figure.h"

#include <gtest/gtest.h>

#include "model/core/index.h"

namespace contort {
namespace {

GuestJoint arm_joint(const std::string& name, const std::string& parent, const std::string& slot) {
  GuestJoint joint;
  joint.name = name, joint.parent = parent, joint.slot = slot, joint.position = Vec3(0.0, 0.3, 0.0);
  return joint;
}

GuestCollider ball_on(const std::string& name, const std::string& joint, double radius) {
  GuestCollider collider;
  collider.name = name, collider.joint = joint, collider.radius = radius;
  return collider;
}

// Three joints above each other, 0.3 m apart, with a ball on the first and on the last, and a small one between them.
GuestManifest chain(double radius) {
  GuestCharacter hero;
  hero.name = "hero";
  hero.joints = {arm_joint("hips", "", ""), arm_joint("arm/upper", "hips", "arm"), arm_joint("arm/lower", "arm/upper", "arm")};
  hero.colliders = {ball_on("hip", "hips", radius), ball_on("hand", "arm/lower", radius),
                    ball_on("elbow", "arm/upper", 0.01)};
  GuestManifest manifest;
  manifest.characters = {hero};
  return manifest;
}

Character built(const GuestManifest& manifest) {
  return build_character({"hero", {}, {}}, library_of(manifest)).value();
}

TEST(GuestFigures, KeepNamesThatBeginWithTheirSlot) {
  const Character character = built(chain(0.1));
  EXPECT_EQ(character.joints()[1].name, "arm/upper");
  EXPECT_EQ(character.joints()[2].name, "arm/lower");
}

TEST(GuestFigures, GiveNamesThatAreTheSameInLettersOfOursANumber) {
  GuestManifest manifest = chain(0.1);
  manifest.characters[0].colliders.push_back(ball_on("Hand", "arm/lower", 0.1));
  const Character character = built(manifest);
  EXPECT_EQ(character.colliders()[2].name, "arm/hand");
  EXPECT_EQ(character.colliders()[3].name, "arm/hand_2");
}

TEST(GuestFigures, JudgeShapesThatAreApartAtRestAndNotSaidToTouch) {
  GuestManifest manifest = chain(0.25);
  EXPECT_EQ(built(manifest).judged_colliders().size(), 1U) << "0.5 m of balls on 0.6 m";
  manifest.characters[0].may_touch = {{"hand", "hip"}};
  EXPECT_TRUE(built(manifest).judged_colliders().empty());
  EXPECT_TRUE(built(chain(0.35)).judged_colliders().empty()) << "they overlap at rest";
}

// In a convention whose up is our forward, the box has the orientation of the manifest.
TEST(GuestFigures, TakeBoxesInTheAxesOfTheGenerator) {
  GuestManifest manifest = chain(0.1);
  manifest.convention = {Axis::plus_z, Axis::minus_y, 0.01, Hand::right};
  GuestCollider& box = manifest.characters[0].colliders[0];
  box.type = GuestShape::box, box.half = Vec3(10.0, 20.0, 30.0), box.center = Vec3(0.0, 0.0, 50.0);
  const Character character = built(manifest);
  const Box& shape = std::get<Box>(character.colliders()[0].shape);
  EXPECT_LT(length(shape.half_m - Vec3(0.1, 0.3, 0.2)), 1e-12);
  EXPECT_LT(length(shape.center_m - Vec3(0.0, 0.5, 0.0)), 1e-12);
  EXPECT_LT(length(shape.rotation_deg), 1e-9);
}

TEST(GuestFigures, TakeTheSwingOfABallAsOneAngleOrAsTwo) {
  GuestManifest manifest = chain(0.1);
  GuestJoint& upper = manifest.characters[0].joints[1];
  upper.swing_deg = 40.0;
  Character character = built(manifest);
  EXPECT_NEAR(character.joints()[1].swing_a_rad, 40.0 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(character.joints()[1].swing_b_rad, 40.0 * kRadPerDeg, 1e-12);
  upper.swing_deg = std::array<double, 2>{40.0, 20.0}, upper.swing_axis = Vec3(0.0, 0.0, 1.0);
  character = built(manifest);
  EXPECT_NEAR(character.joints()[1].swing_b_rad, 20.0 * kRadPerDeg, 1e-12);
  EXPECT_LT(length(character.joints()[1].swing_axis - Vec3(0.0, 0.0, 1.0)), 1e-12);
}

}  // namespace
}  // namespace contort
