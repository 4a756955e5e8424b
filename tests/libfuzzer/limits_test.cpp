// Inputs that want time or memory: as large as is allowed, and one larger. Small files that would cost minutes.
#include "formats/gltf/limits.h"

#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>

#include "formats/gltf/read.h"
#include "formats/mocap/amc.h"
#include "formats/mocap/asf.h"
#include "formats/mocap/bvh.h"
#include "formats/mocap/limits.h"
#include "generator/stage.h"
#include "model/character/assembly.h"
#include "tests/corpus/temp_folder.h"
#include "tests/gltf/glb_builder.h"

namespace contort {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string times(std::size_t count, const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) out += text;
  return out;
}

// With 10^11 comparisons (each object with all earlier ones) reading would take minutes.
TEST(LargeInput, AListOfManyObjectsIsReadInTheTimeOfItsLength) {
  const double start = cpu_seconds();
  EXPECT_EQ(parse_spec("[" + times(500'000, "{},") + "{}]").issue().code, "spec.wrong_type");
  EXPECT_LT(cpu_seconds() - start, 10.0);  // 0.3 s at -O2; ASan takes ten times as long
}

Spec many_actions(std::size_t count) {
  Spec spec;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 2500 == 0) spec.sequences.push_back({"", 0, std::vector<ClipDesc>(10)});
    ActionUse use;
    use.slot = "head", use.duration_frames = 1;
    spec.sequences.back().clips[i % 10].actions.push_back(use);
  }
  return spec;
}

TEST(LargeInput, TenThousandActionsAreTheLimit) {
  EXPECT_TRUE(build_stage(many_actions(10'000), stock_library()).ok());
  const Result<Stage> more = build_stage(many_actions(10'001), stock_library());
  ASSERT_FALSE(more.ok());
  EXPECT_EQ(more.issue().code, "spec.too_many");
  EXPECT_EQ(more.issue().pointer, "/sequences/4");
}

// Slots in a row, each with a part of 64 colliders.
Result<Character> tower(std::size_t slots) {
  PartDesc block;
  block.name = block.kind = "block";
  for (int i = 0; i < 64; ++i) block.colliders.push_back({"c" + std::to_string(i), "", Sphere{Vec3(0.0), 0.1}});
  block.sockets = {{"top", "", Vec3(0, 1, 0), Vec3(0.0)}};
  CharacterDesc desc;
  desc.name = "tower";
  for (std::size_t i = 0; i < slots; ++i) {
    const std::string below = i == 0 ? "" : "s" + std::to_string(i - 1);
    desc.slots.push_back({"s" + std::to_string(i), "block", Side::center, below, i == 0 ? "" : "top", {"block"}});
  }
  for (int i = 0; i < 1000; ++i) desc.allowed_pairs.push_back({"s0/c1", "s1/c" + std::to_string(i % 64), "touch"});
  Library library;
  library.parts["block"] = block;
  library.characters["tower"] = desc;
  return build_character({"tower", {}, {}}, library);
}

TEST(LargeInput, CharactersHaveALimitOfColliders) {
  const std::size_t most = kMaxCharacterColliders / 64;
  const Result<Character> largest = tower(most);
  ASSERT_TRUE(largest.ok()) << to_line(largest.issue());
  EXPECT_EQ(largest->colliders().size(), kMaxCharacterColliders);
  const Result<Character> larger = tower(most + 1);
  ASSERT_FALSE(larger.ok());
  EXPECT_EQ(larger.issue().code, "character.too_large");
  EXPECT_EQ(larger.issue().pointer, "/parts/s16");
}

std::string bvh_of(std::int64_t frames) {
  return "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\nMOTION\nFrames: " + std::to_string(frames) +
         "\nFrame Time: 0.01\n";
}

TEST(LargeInput, KeysOfMotionCaptureHaveALimit) {
  EXPECT_EQ(parse_bvh(bvh_of(kMaxMocapKeys) + times(kMaxMocapKeys, "\n"), "").issue().code, "bvh.too_few_values");
  EXPECT_EQ(parse_bvh(bvh_of(kMaxMocapKeys + 1), "").issue().code, "bvh.too_large");
}

AsfSkeleton bones_that_stay(int count) {
  std::string bones, names;
  for (int i = 0; i < count; ++i) {
    const std::string name = "b" + std::to_string(i);
    bones += "begin\nname " + name + "\ndirection 1 0 0\nlength 1\naxis 0 0 0 XYZ\nend\n";
    names += " " + name;
  }
  return *parse_asf(":root\norder rx\naxis XYZ\nposition 0 0 0\norientation 0 0 0\n:bonedata\n" + bones +
                    ":hierarchy\nbegin\nroot" + names + "\nend\n");
}

std::string amc_of(int frames) {
  std::string out;
  for (int i = 1; i <= frames; ++i) out += std::to_string(i) + "\nroot 1\n";
  return out;
}

// 3 * 10^8 needless rotations would take 15 s.
TEST(LargeInput, BonesThatStayCostNoTimeInEachFrame) {
  const AsfSkeleton skeleton = bones_that_stay(16'000);
  const Result<AmcMotion> motion = parse_amc(amc_of(20'000), skeleton);
  ASSERT_TRUE(motion.ok());
  const double start = cpu_seconds();
  EXPECT_EQ(to_asset(skeleton, *motion, 120.0, "").clips.front().channels.size(), 1U);
  EXPECT_LT(cpu_seconds() - start, 2.0);
}

// Each buffer needs one byte of a file that must be read completely.
TEST(LargeInput, BuffersAreReadUpToALimitAndNotOnceForEachThatNamesAFile) {
  const TempFolder folder;
  fixtures::Json root = fixtures::small_arm().document();
  for (int i = 0; i < 1000; ++i) root["buffers"].push_back({{"byteLength", 1}, {"uri", "large.bin"}});
  root["buffers"][0]["uri"] = "large.bin";
  spill(folder / "arm.gltf", root.dump());
  spill(folder / "large.bin", "");
  std::filesystem::resize_file(folder / "large.bin", kMaxGltfBytes / 4);
  const Result<Asset> asset = read_gltf(folder / "arm.gltf");
  ASSERT_FALSE(asset.ok());
  EXPECT_EQ(asset.issue().code, "gltf.too_large");
  EXPECT_EQ(asset.issue().pointer, "/buffers/4");
}

}  // namespace
}  // namespace contort
