// The joints of a model that a manifest names.
#include "guest/model_joints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "guest/guest_figure.h"

namespace contort {
namespace {

// Three joints above one another, each turned by a quarter about x against the one before; a capsule on the last.
GuestCharacter tower() {
  GuestCharacter out;
  const double half = std::sqrt(0.5);
  for (const char* name : {"hips", "spine", "head"}) {
    GuestJoint joint;
    joint.name = name;
    if (!out.joints.empty()) joint.parent = out.joints.back().name;
    joint.position = {0, 1, 0}, joint.rotation = {half, 0, 0, half};
    out.joints.push_back(joint);
  }
  GuestCollider skull;
  skull.name = "skull", skull.joint = "head", skull.from = {0, 0, 0}, skull.to = {0, 0.2, 0};
  out.colliders.push_back(skull);
  return out;
}

constexpr char kHead[] = R"({"contort":1,"name":"g","actions":[{"name":"nod"}],"characters":[{"name":"hero","model":"m.glb",
  "joints":[{"name":"hips"},{"name":"head","type":"hinge","axis":[1,0,0],"low_deg":-30}]}]})";

Result<GuestCharacter> read_tower(const std::string& path) {
  EXPECT_EQ(path, "m.glb");
  return tower();
}

TEST(ModelJoints, HangOnTheNearestThatIsThereInTheSamePlace) {
  const Result<GuestManifest> manifest = parse_manifest(kHead, read_tower);
  ASSERT_TRUE(manifest) << to_line(manifest.issue());
  const GuestCharacter& hero = manifest->characters[0];
  ASSERT_EQ(hero.joints.size(), 2U);
  EXPECT_EQ(hero.joints[1].parent, "hips");
  EXPECT_NEAR(hero.joints[1].position.y, 1.0, 1e-12);
  EXPECT_NEAR(hero.joints[1].position.z, 1.0, 1e-12) << "the spine is turned by a quarter";
  EXPECT_NEAR(std::fabs(hero.joints[1].rotation[0]), 1.0, 1e-12) << "half a turn";
  EXPECT_EQ(hero.joints[1].type, GuestJointType::hinge) << "the manifest says so";
  EXPECT_EQ(hero.joints[1].low_deg, -30.0);
  ASSERT_EQ(hero.colliders.size(), 1U);
}

TEST(ModelJoints, CarryTheCollidersOfThoseThatAreLeftOut) {
  const Result<GuestCharacter> hips = with_joints(tower(), std::vector<std::string>{"hips"});
  ASSERT_TRUE(hips) << to_line(hips.issue());
  const GuestCollider& skull = hips->colliders.at(0);
  EXPECT_EQ(skull.joint, "hips");
  EXPECT_NEAR(skull.from.y, 1.0, 1e-12);
  EXPECT_NEAR(skull.from.z, 1.0, 1e-12);
  EXPECT_NEAR(skull.to.y, 0.8, 1e-12) << "upside down after half a turn";
}

TEST(ModelJoints, AreAllOfThemWhereTheManifestNamesNone) {
  const Result<GuestManifest> manifest = parse_manifest(
      R"({"contort":1,"name":"g","actions":[{"name":"nod"}],"characters":[{"name":"hero","model":"m.glb"}]})", read_tower);
  ASSERT_TRUE(manifest) << to_line(manifest.issue());
  EXPECT_EQ(manifest->characters[0].joints, tower().joints);
}

TEST(ModelJoints, AreToldWhereTheModelHasNoSuchOne) {
  std::string json = kHead;
  json.replace(json.find("\"head\""), 6, "\"heat\"");
  const Issue issue = parse_manifest(json, read_tower).issue();
  EXPECT_EQ(to_line(issue), "generator.unknown_joint at /characters/0/joints/1/name: \"heat\" is no joint of the model, "
                            "which has hips, spine, head; did you mean \"head\"?");
  EXPECT_EQ(parse_manifest(kHead).issue().code, "generator.no_models");
}

TEST(ModelJoints, MakeAnotherGeneratorWhereTheModelIsAnother) {
  const auto hash = [](const ModelReader& reader) { return manifest_hash(*parse_manifest(kHead, reader)); };
  const auto longer = [](const std::string& path) -> Result<GuestCharacter> {
    GuestCharacter tall = *read_tower(path);
    tall.joints[1].position.y = 2.0;
    return tall;
  };
  EXPECT_EQ(hash(read_tower), hash(read_tower));
  EXPECT_NE(hash(read_tower), hash(longer));
}

}  // namespace
}  // namespace contort
