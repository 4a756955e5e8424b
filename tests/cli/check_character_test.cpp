// contort check of animations as motions of a character, as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/gltf/write.h"
#include "tests/character/stock.h"
#include "tests/checks/small_character.h"
#include "tests/cli/program.h"

namespace contort {
namespace {

using Json = nlohmann::json;

bool tells_of(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

class CheckCharacter : public testing::Test {
 protected:
  // The human at rest for 20 frames at 30 Hz, but for its left elbow.
  std::string bent(const std::string& name, const std::vector<std::pair<int, double>>& elbow_rad) const {
    Motion motion = small::at_rest(human_, 20, 30.0);
    for (int f = 0; f < 20; ++f) small::set(motion, f, elbow(), 0.5 * (elbow().low + elbow().high));
    for (const auto& [frame, angle] : elbow_rad) small::set(motion, frame, elbow(), angle);
    std::filesystem::create_directories(std::filesystem::path(folder_ / name).parent_path());
    EXPECT_TRUE(save_glb(folder_ / name, human_, motion, {}));
    return folder_ / name;
  }
  const Joint& elbow() const { return small::joint_of(human_, "arm_left/elbow"); }

  TempFolder folder_;
  Character human_ = fixtures::human();
};

TEST_F(CheckCharacter, AClipIsJudgedByEveryCheckThatAppliesAndTheVerdictSaysSo) {
  const Ran ran = contort_program({"check", bent("calm.glb", {}), "--character", "human"});
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  const std::string joints = std::to_string(human_.joints().size());
  EXPECT_TRUE(tells_of(ran.out, ", " + joints + " of " + joints + " joints, ")) << ran.out;
  EXPECT_TRUE(tells_of(ran.out, " limits, 20 frames")) << ran.out;
  EXPECT_TRUE(tells_of(ran.out, "\n  reach_error could not judge: nothing says what the motion was meant to do "))
      << ran.out;
  EXPECT_TRUE(tells_of(ran.out, "\n  Only for external generators (--generator): off_axis, root_pop, ")) << ran.out;
  EXPECT_TRUE(tells_of(ran.out, "\n  tracking_error could not judge: the motion has no dynamics\n")) << ran.out;
  const Ran as_json = contort_program({"check", folder_ / "calm.glb", "--character", "human", "--json"});
  const Json clip = Json::parse(as_json.out)["clips"][0];
  std::set<std::string> judged;
  for (const Json& check : clip["judged"]) judged.insert(check["check"]);
  for (const char* check : {"non_finite", "joint_range", "angular_velocity", "pop", "angular_acceleration",
                            "ground_penetration", "foot_slide", "self_collision", "bind_pose_flash"})
    EXPECT_TRUE(judged.contains(check)) << check;
  EXPECT_EQ(clip["conversion"]["joints"], human_.joints().size());
  EXPECT_EQ(clip["conversion"]["frames"], 20);
  EXPECT_EQ(clip["conversion"]["root_path"], "told");
}

TEST_F(CheckCharacter, FindingsOfTheFileAndOfTheMotionAreInOneList) {
  const double high = elbow().high + 0.05;
  const std::string file = bent("bent.glb", {{10, high}, {11, high}, {12, high}, {13, high}});
  const Ran ran = contort_program({"check", file, "--character", "human"});
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_TRUE(tells_of(ran.out, "  joint_range  arm_left/elbow max  is at ")) << ran.out;
  EXPECT_TRUE(tells_of(ran.out, "\u00B0  frames 10-13, worst 1")) << ran.out;
  EXPECT_EQ(contort_program({"check", file}).code, 0) << "nothing of that shows without a character";
}

TEST_F(CheckCharacter, APopIsReportedOnce) {
  const std::string file = bent("pop.glb", {{10, elbow().high - 0.05}, {11, elbow().low + 0.05}});
  const Json clip = Json::parse(contort_program({"check", file, "--character", "human", "--json",
                                                 "--max-speed-deg-s", "100000"}).out)["clips"][0];
  int pops = 0;
  for (const Json& finding : clip["findings"])
    if (finding["check"] == "pop" || finding["check"] == "angular_velocity") {
      ++pops;
      EXPECT_TRUE(finding.contains("speed_deg_s")) << "between the file's own keys: " << finding;
    }
  EXPECT_EQ(pops, 1) << clip["findings"];
}

// A leg as a solver without ranges leaves it: thigh, shin and foot, with the shin turned the wrong way.
std::string bvh_of_a_leg(double shin_deg) {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT Thigh\n{\nOFFSET 0.1 0 0\n"
      "CHANNELS 3 Zrotation Xrotation Yrotation\nJOINT Shin\n{\nOFFSET 0 -0.45 0.02\nCHANNELS 3 Zrotation Xrotation "
      "Yrotation\nEnd Site\n{\nOFFSET 0 -0.45 -0.02\n}\n}\n}\n}\nMOTION\nFrames: 12\nFrame Time: 0.0333333\n";
  for (int frame = 0; frame < 12; ++frame) text += "0 0 0 0 0 0 0 " + std::to_string(shin_deg) + " 0\n";
  return text;
}

TEST_F(CheckCharacter, AKneeThatBendsBackwardsIsFoundInABvh) {
  spill(folder_ / "map.json", R"({"format": "contort.map/1", "joints": {"Thigh": "leg_left/hip_rot", "Shin": "leg_left/knee"}})");
  const auto checked = [&](double shin_deg, bool has_character) {
    spill(folder_ / "leg.bvh", bvh_of_a_leg(shin_deg));
    std::vector<std::string> arguments = {"check", folder_ / "leg.bvh", "--unit", "m"};
    if (has_character) arguments.insert(arguments.end(), {"--character", "human", "--map", folder_ / "map.json"});
    return contort_program(arguments);
  };
  const Ran backwards = checked(-33.0, true);
  EXPECT_EQ(backwards.code, 1) << backwards.out << backwards.err;
  EXPECT_TRUE(tells_of(backwards.out, "joint_range  leg_left/knee min")) << backwards.out;
  EXPECT_EQ(checked(33.0, true).code, 0) << "as knees bend";
  EXPECT_EQ(checked(-33.0, false).code, 0) << "nothing says what the joint is";
}

TEST_F(CheckCharacter, ACharacterThatMatchesNothingIsAnError) {
  for (const char* name : {"stranger", "root"}) {
    const std::string file = folder_ / (std::string(name) + ".bvh");
    spill(file, std::string("HIERARCHY\nROOT ") + name +
                    "\n{\nOFFSET 0 1 0\nCHANNELS 1 Zrotation\n}\nMOTION\nFrames: 3\nFrame Time: 0.1\n0\n1\n2\n");
    const Ran ran = contort_program({"check", file, "--character", "human"});
    EXPECT_EQ(ran.code, 2) << name << ": " << ran.out;
    EXPECT_EQ(ran.out, "");
    EXPECT_TRUE(tells_of(ran.err, "check.nothing_matches: ") && tells_of(ran.err, std::string("nodes are ") + name)) << ran.err;
    EXPECT_TRUE(tells_of(ran.err, "arm_left/")) << "joints are named, too: " << ran.err;
    const Ran all = contort_program({"check", file, "--all-clips", "--character", "human", "--allow-unreadable"});
    EXPECT_EQ(all.code, 2) << all.out;
    EXPECT_FALSE(tells_of(all.out, "OK")) << all.out;
  }
}

TEST_F(CheckCharacter, EveryClipOfEveryFileIsJudgedOnIt) {
  bent("a/calm.glb", {});
  bent("a/bent.glb", {{10, elbow().high + 0.05}});
  const Ran ran = contort_program({"check", folder_ / "a", "--all-clips", "--character", "human"});
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_TRUE(tells_of(ran.out, "40 frames, in 2 motions")) << ran.out;
  const Ran as_json = contort_program({"check", folder_ / "a", "--all-clips", "--character", "human", "--json"});
  const Json all = Json::parse(as_json.out);
  ASSERT_EQ(all["clips"].size(), 2U);
  for (const Json& clip : all["clips"]) EXPECT_FALSE(clip["judged"].empty());
}

TEST_F(CheckCharacter, TheRateMayBeGiven) {
  const std::string file = bent("calm.glb", {});
  const auto frames = [&](const std::vector<std::string>& more) {
    std::vector<std::string> args = {"check", file, "--character", "human", "--json"};
    args.insert(args.end(), more.begin(), more.end());
    return Json::parse(contort_program(args).out)["clips"][0]["conversion"]["frames"].get<int>();
  };
  EXPECT_EQ(frames({}), 20);
  EXPECT_EQ(frames({"--rate-hz", "60"}), 39);
}

}  // namespace
}  // namespace contort
