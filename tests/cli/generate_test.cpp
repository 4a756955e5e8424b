// contort generate, and levels of specs, as a user runs them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/gltf/read.h"
#include "tests/cli/program.h"

namespace contort {
namespace {

using Json = nlohmann::json;

const std::string kTwoSequences = CONTORT_SOURCE_DIR "/docs/examples/rifle_two_sequences.json";

class GenerateCommand : public testing::Test {
 protected:
  TempFolder folder_;
};

TEST_F(GenerateCommand, WritesATableOfNumbersToo) {
  const std::string path = folder_ / "motion.json";
  ASSERT_EQ(contort_program({"generate", kTwoSequences, "-o", path}).code, 0);
  const Json table = Json::parse(slurp(path), nullptr, false);
  ASSERT_TRUE(table.is_object());
  EXPECT_EQ(table["first_frame"], 0);
  EXPECT_EQ(table["frames"].size(), 106U);
}

TEST_F(GenerateCommand, WritesALevelAlone) {
  const std::string path = folder_ / "level.json", spec = kTwoSequences;
  ASSERT_EQ(contort_program({"generate", spec, "--level", "sequence:2", "-o", path}).code, 0);
  const Json second = Json::parse(slurp(path), nullptr, false);
  ASSERT_EQ(contort_program({"generate", spec, "-o", path}).code, 0);
  const Json whole = Json::parse(slurp(path), nullptr, false);
  EXPECT_GT(second["first_frame"], 0);
  EXPECT_EQ(second["frames"].size() + second["first_frame"].get<std::size_t>(), whole["frames"].size());
  EXPECT_EQ(second["frames"].front(), whole["frames"][second["first_frame"].get<std::size_t>()]);
}

TEST_F(GenerateCommand, WritesTheAnimationOfAPartAlone) {
  const std::string path = folder_ / "part.glb", spec = kTwoSequences;
  ASSERT_EQ(contort_program({"generate", spec, "--level", "part:arm_right", "-o", path}).code, 0);
  const Result<Asset> asset = read_gltf(path);
  ASSERT_TRUE(asset.ok()) << to_line(asset.issue());
  ASSERT_EQ(asset->clips.size(), 1U);
  ASSERT_FALSE(asset->clips[0].channels.empty());
  for (const AssetChannel& channel : asset->clips[0].channels)
    EXPECT_TRUE(asset->nodes[static_cast<std::size_t>(channel.node)].name.starts_with("arm_right/"));
}

TEST_F(GenerateCommand, LevelsOfAnimationsAreRefused) {
  const std::string animation = folder_ / "a.bvh";
  spill(animation, "HIERARCHY");
  const Ran ran = contort_program({"check", animation, "--level", "clip:1/1"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("usage.for_specs"), std::string::npos) << ran.err;
}

TEST(GenerateRecording, TheMapBesideAnImportedCharacterAppliesAndABrokenOneIsNamed) {
  const TempFolder folder;
  const std::string walk = folder / "walk.json", play = folder / "play.json", library = folder / "library";
  std::filesystem::create_directories(library + "/maps");
  spill(walk, R"({"format": "contort.spec/1", "character": {"name": "human"}, "sequences": [{"clips": [{"actions": [
    {"action": "walk", "slot": "waist", "duration_frames": 30}]}]}]})");
  spill(play, R"({"format": "contort.spec/1", "character": {"name": "human"}, "recording": {"name": "walk"}})");
  ASSERT_EQ(contort_program({"generate", walk, "-o", library + "/walk.glb"}).code, 0);
  const auto played = [&] {
    const Ran ran = contort_program({"--library", library, "generate", play, "-o", folder / "out.glb"});
    return ran.code == 0 ? slurp(folder / "out.glb") : ran.err;
  };
  const std::string by_names = played();
  spill(library + "/maps/human.json", R"({"format": "contort.map/1", "joints": {"leg_left/knee": "leg_right/knee"}})");
  const std::string by_map = played();
  EXPECT_EQ(by_map.substr(0, 4), "glTF") << by_map;
  EXPECT_NE(by_map, by_names);
  spill(library + "/maps/human.json", "{");
  EXPECT_NE(played().find("maps/human.json"), std::string::npos);
}

}  // namespace
}  // namespace contort
