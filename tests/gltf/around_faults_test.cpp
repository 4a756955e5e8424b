// A reader that skips faults reads all channels except for those with a fault.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "formats/gltf/read.h"
#include "tests/corpus/temp_folder.h"
#include "tests/gltf/glb_builder.h"

namespace contort {
namespace {

using fixtures::GlbBuilder;
using fixtures::small_arm;

// Views of small_arm: 1 and 2 are times and rotations of "wave", 3 and 4 times and places of "push".
GlbBuilder arm_with(std::size_t view, std::size_t index, float value) {
  GlbBuilder b = small_arm();
  const std::size_t offset = b.root["bufferViews"][view]["byteOffset"];
  std::memcpy(b.bin.data() + offset + 4 * index, &value, 4);
  return b;
}

Result<Asset> around_faults(const GlbBuilder& b) {
  const TempFolder folder;
  const fixtures::ByteList bytes = b.glb();
  spill(folder / "arm.glb", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  EXPECT_FALSE(read_gltf(folder / "arm.glb")) << "the other reader refuses it";
  return read_gltf_around_faults(folder / "arm.glb");
}

TEST(AroundFaults, AValueThatIsNoNumberLeavesItsChannelOut) {
  const Result<Asset> asset = around_faults(arm_with(4, 4, std::numeric_limits<float>::quiet_NaN()));
  ASSERT_TRUE(asset) << asset.issue().text;
  ASSERT_EQ(asset->faults.size(), 1U);
  EXPECT_EQ(asset->faults[0].clip, "push");
  EXPECT_EQ(asset->faults[0].node, 2);
  EXPECT_EQ(asset->faults[0].code, "gltf.not_finite");
  EXPECT_EQ(asset->faults[0].key, -1);
  ASSERT_EQ(asset->clips.size(), 2U);
  EXPECT_EQ(asset->clips[0].channels.size(), 1U) << "the other clip is there";
  EXPECT_TRUE(asset->clips[1].channels.empty());
}

TEST(AroundFaults, ATurnOfNoLengthIsTheKeyBeforeIt) {
  GlbBuilder b = arm_with(2, 4, 0.0F);
  std::memset(b.bin.data() + b.root["bufferViews"][2]["byteOffset"].get<std::size_t>() + 16, 0, 16);
  const Result<Asset> asset = around_faults(b);
  ASSERT_TRUE(asset) << asset.issue().text;
  ASSERT_EQ(asset->faults.size(), 1U);
  EXPECT_EQ(asset->faults[0].clip, "wave");
  EXPECT_EQ(asset->faults[0].key, 1);
  EXPECT_EQ(asset->faults[0].length, 0.0);
  EXPECT_EQ(asset->clips[0].channels[0].values, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1}));
}

TEST(AroundFaults, BindMatricesThatAreMissingConcernAllClips) {
  GlbBuilder b = small_arm();
  b.root["accessors"][0]["count"] = 2;
  const Result<Asset> asset = around_faults(b);
  ASSERT_TRUE(asset) << asset.issue().text;
  ASSERT_EQ(asset->faults.size(), 1U);
  EXPECT_EQ(asset->faults[0].clip, "");
  EXPECT_EQ(asset->skins[0].joint_from_mesh.size(), 3U);
  EXPECT_TRUE(asset->nodes[2].is_joint);
}

TEST(AroundFaults, ChannelsThatMoveNoJointAreCounted) {
  GlbBuilder b = small_arm();
  b.root["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"node", 3}, {"path", "weights"}}}});
  const fixtures::ByteList bytes = b.glb();
  const Result<Asset> asset = parse_glb(bytes);
  ASSERT_TRUE(asset) << asset.issue().text;
  EXPECT_EQ(asset->clips[0].not_read, (std::map<std::string, int>{{"morph weights", 1}}));
  EXPECT_TRUE(asset->clips[1].not_read.empty());
}

}  // namespace
}  // namespace contort
