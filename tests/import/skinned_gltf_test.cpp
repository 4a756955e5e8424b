// Reading skinned meshes from files that lie.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/import/rigged_model.h"

namespace contort {
namespace {

using fixtures::GlbBuilder;
using fixtures::rigged;
using fixtures::worm;

std::string code_of(const GlbBuilder& b) {
  const Result<SkinnedAsset> read = parse_skinned_glb(b.glb());
  return read.ok() ? "" : read.issue().code;
}

fixtures::Json& attributes(GlbBuilder& b) { return b.root["meshes"][0]["primitives"][0]["attributes"]; }

TEST(SkinnedGltf, VerticesComeWithJointsWeightsAndTriangles) {
  const Result<SkinnedAsset> read = parse_skinned_glb(rigged(worm(2)).glb());
  ASSERT_TRUE(read.ok()) << to_line(read.issue());
  ASSERT_EQ(read->meshes.size(), 1U);
  const SkinnedMesh& mesh = read->meshes[0];
  ASSERT_EQ(mesh.vertices.size(), 16U);
  EXPECT_EQ(mesh.indices.size(), 72U);
  EXPECT_EQ(mesh.vertices[8].joints[0], 1);
  EXPECT_EQ(mesh.vertices[8].weights[0], 1.0);
  EXPECT_NEAR(mesh.vertices[0].position.x, -0.1, 1e-6);
}

TEST(SkinnedGltf, WeightsBecomeSharesOfOne) {
  GlbBuilder b = rigged(worm(2));
  std::vector<float> weights(64, 0.5F);
  weights[0] = -3.0F;
  attributes(b)["WEIGHTS_0"] = b.add_vec4(weights);
  const Result<SkinnedAsset> read = parse_skinned_glb(b.glb());
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->meshes[0].vertices[1].weights[3], 0.25);
  EXPECT_EQ(read->meshes[0].vertices[0].weights[0], 0.0);
}

TEST(SkinnedGltf, StripsAndFansAreTriangles) {
  for (const int mode : {5, 6}) {
    GlbBuilder b = rigged(worm(2));
    b.root["meshes"][0]["primitives"][0]["mode"] = mode;
    b.root["meshes"][0]["primitives"][0]["indices"] = b.add(std::vector<std::uint16_t>{0, 1, 2, 3}, 5123, "SCALAR", 1);
    const Result<SkinnedAsset> read = parse_skinned_glb(b.glb());
    ASSERT_TRUE(read.ok());
    const std::vector<int> expected =
        mode == 5 ? std::vector<int>{0, 1, 2, 2, 1, 3} : std::vector<int>{0, 1, 2, 0, 2, 3};
    EXPECT_EQ(read->meshes[0].indices, expected);
  }
}

TEST(SkinnedGltf, LiesAreRefusedByName) {
  GlbBuilder joint = rigged(worm(2));
  std::vector<std::uint8_t> joints(64, 7);
  attributes(joint)["JOINTS_0"] = joint.add(joints, 5121, "VEC4", 4);
  EXPECT_EQ(code_of(joint), "gltf.bad_index");
  GlbBuilder index = rigged(worm(2));
  index.root["meshes"][0]["primitives"][0]["indices"] =
      index.add(std::vector<std::uint16_t>{0, 1, 16}, 5123, "SCALAR", 1);
  EXPECT_EQ(code_of(index), "gltf.bad_index");
  GlbBuilder few = rigged(worm(2));
  attributes(few)["WEIGHTS_0"] = few.add_vec4({1, 0, 0, 0});
  EXPECT_EQ(code_of(few), "gltf.bad_mesh");
  GlbBuilder nan = rigged(worm(2));
  attributes(nan)["POSITION"] = nan.add_vec3(std::vector<float>(48, std::nanf("")));
  EXPECT_EQ(code_of(nan), "gltf.not_finite");
  GlbBuilder signed_joints = rigged(worm(2));
  attributes(signed_joints)["JOINTS_0"] = signed_joints.add(std::vector<std::int8_t>(64, 0), 5120, "VEC4", 4);
  EXPECT_EQ(code_of(signed_joints), "gltf.bad_accessor");
  GlbBuilder compressed = rigged(worm(2));
  compressed.root["accessors"][static_cast<std::size_t>(attributes(compressed)["POSITION"].get<int>())].erase(
      "bufferView");
  EXPECT_EQ(code_of(compressed), "gltf.unsupported");
}

// A reader for nodes and clips ignores meshes.
TEST(SkinnedGltf, BadMeshesHinderNobodyElse) {
  GlbBuilder b = rigged(worm(2));
  attributes(b)["POSITION"] = 9999;
  EXPECT_EQ(code_of(b), "gltf.bad_index");
  EXPECT_TRUE(parse_glb(b.glb()).ok());
}

// After any change, the result is a figure or an issue.
RC_GTEST_PROP(SkinnedGltf, ChangedBytesNeverCrashAnImport, ()) {
  fixtures::ByteList glb = rigged(worm(3)).glb();
  const auto changes = *rc::gen::container<std::vector<std::pair<std::uint16_t, std::uint8_t>>>(
      rc::gen::arbitrary<std::pair<std::uint16_t, std::uint8_t>>());
  for (const auto& [place, value] : changes) glb[20 + place % (glb.size() - 20)] = static_cast<std::byte>(value);
  const Result<SkinnedAsset> read = parse_skinned_glb(glb);
  if (!read.ok()) return RC_ASSERT(read.issue().code.starts_with("gltf."));
  ImportOptions options;
  options.name = "figure";
  const Result<Imported> in = import_model(*read, options);
  if (!in.ok()) RC_ASSERT(in.issue().code.starts_with("import."));
}

RC_GTEST_PROP(SkinnedGltf, OddNumbersNeverBreakAFigure, ()) {
  GlbBuilder b = rigged(worm(3));
  const auto odd = rc::gen::element(0.0, -1.0, 1e-30, 1e30, 3.0, 1e5, 1e-5);
  const std::size_t node = *rc::gen::inRange<std::size_t>(0, 4);
  const std::string field = *rc::gen::element<std::string>("translation", "scale");
  b.root["nodes"][node][field] = {*odd, *odd, *odd};
  const Result<Imported> in = fixtures::imported(b);
  if (!in.ok()) RC_ASSERT(in.issue().code.starts_with("import.") || in.issue().code.starts_with("gltf."));
}

}  // namespace
}  // namespace contort
