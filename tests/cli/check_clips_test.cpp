// contort check on motion capture and on many files, as a user runs it.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/mocap/asf_text.h"
#include "tests/mocap/bvh_text.h"

namespace contort {
namespace {

using Json = nlohmann::json;

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

// One joint about Z at 100 frames per second, by these angles.
std::string bvh_of(const std::string& joint, const std::vector<double>& angles_deg) {
  std::string text = "HIERARCHY\nROOT " + joint + "\n{\nOFFSET 0 0 0\nCHANNELS 1 Zrotation\n}\nMOTION\nFrames: " +
                     std::to_string(angles_deg.size()) + "\nFrame Time: 0.01\n";
  for (const double angle : angles_deg) text += std::to_string(angle) + "\n";
  return text;
}

class CheckClips : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(folder_ / name).parent_path());
    spill(folder_ / name, text);
    return folder_ / name;
  }
  TempFolder folder_;
};

TEST_F(CheckClips, ABvhIsCheckedAndAPopIsNamedSo) {
  const std::string path = file("take.bvh", bvh_of("arm", {90, 0, 1, 2, 3, 4}));
  const Ran ran = contort_program({"check", path});
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_TRUE(has(ran.out, "clip take: peak 9000.0 deg/s at arm, 0.000-0.010 s")) << ran.out;
  EXPECT_TRUE(has(ran.out, "  pop  arm  9000.0 deg/s, allowed 3000.0  at 0.000-0.010 s")) << ran.out;
  EXPECT_EQ(last_line(ran.out), "RESULT findings=1 clips=1");
  const Ran faster = contort_program({"check", path, "--max-speed-deg-s", "9001"});
  EXPECT_TRUE(has(faster.out, "  pop  arm  9000.0 deg/s, allowed 2000.0  at 0.000-0.010 s, 90.0 deg in one step"))
      << "a jump that stands alone is one at any speed limit\n" << faster.out;
  EXPECT_EQ(contort_program({"check", file("slow.bvh", bvh_of("arm", {15, 0, 1, 2, 3, 4}))}).code, 0);
}

TEST_F(CheckClips, ABvhThatIsBrokenIsRefusedWithItsLine) {
  const Ran ran = contort_program({"check", file("a.bvh", replaced(small_bvh(), "1.25e1", "x"))});
  EXPECT_EQ(ran.code, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_TRUE(has(ran.err, "bvh.bad_number at line 12: ")) << ran.err;
}

TEST_F(CheckClips, AnAmcIsJudgedByItsOwnLimits) {
  file("tiny.asf", small_asf());
  const std::string amc = file("tiny_01.amc", small_amc());
  const Ran ran = contort_program({"check", amc, "--rate-hz", "1"});
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_TRUE(has(ran.out, "declared limits: 3 of 12 samples out of range, worst 2.0 deg at hand ry min, frame 9"))
      << ran.out;
  EXPECT_TRUE(has(ran.out, "  joint_range  arm ry min  1.5 deg out of range  frames 8-8, worst 8 (2.000 s)"))
      << ran.out;
  EXPECT_EQ(last_line(ran.out), "RESULT findings=3 clips=1");
  const Json out = Json::parse(contort_program({"check", amc, "--rate-hz", "1", "--json"}).out, nullptr, false);
  ASSERT_TRUE(out.is_object());
  EXPECT_EQ(out["clips"][0]["samples"], 12);
  EXPECT_EQ(out["clips"][0]["samples_out_of_range"], 3);
  EXPECT_EQ(out["clips"][0]["findings"][0]["check"], "joint_range");
  EXPECT_EQ(out["clips"][0]["findings"][0]["worst_frame"], 7);
}

// Returns the number of findings of joint_range, and the number of those with this subject.
std::pair<int, int> range_findings(const Ran& ran, const std::string& subject) {
  const Json out = Json::parse(ran.out, nullptr, false);
  std::pair<int, int> counts;
  for (const Json& finding : out.at("clips").at(0).at("findings"))
    if (finding.at("check") == "joint_range")
      ++counts.first, counts.second += finding.at("subject") == subject ? 1 : 0;
  return counts;
}

TEST_F(CheckClips, ALimitThatTheCharacterHasFromTheFileIsJudgedOnce) {
  const std::string asf = file("tiny.asf", small_asf()), library = folder_ / "people";
  const std::string amc = file("tiny_01.amc", small_amc());
  ASSERT_EQ(contort_program({"import", asf, "-o", library}).code, 0);
  const std::vector<std::string> call = {"--library", library, "check", amc, "--character", "tiny", "--json"};
  EXPECT_EQ(range_findings(contort_program(call), "hand ry max"), std::pair(3, 1));
  const std::string of_file = "\"high_deg\": 45.0", part = library + "/tiny_arm.json";
  ASSERT_TRUE(has(slurp(part), of_file));
  spill(part, replaced(slurp(part), of_file, "\"high_deg\": 40.0"));
  const Ran narrower = contort_program(call);
  EXPECT_EQ(range_findings(narrower, "hand ry max"), std::pair(4, 1)) << narrower.err << narrower.out;
  EXPECT_EQ(range_findings(narrower, "arm/hand_ry max").second, 1) << "that limit is the character's own now";
}

TEST_F(CheckClips, TheSkeletonIsTheOneNamedMostAlike) {
  const std::string amc = file("07_01.amc", small_amc());
  Ran ran = contort_program({"check", amc});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(has(ran.err, "check.no_skeleton: there is no .asf beside")) << ran.err;
  file("anything.asf", small_asf());
  EXPECT_EQ(contort_program({"check", amc}).code, 1) << "the only one";
  file("07.asf", "not a skeleton");
  ran = contort_program({"check", amc});
  EXPECT_TRUE(has(ran.err, "asf.bad_syntax") && has(ran.err, "07.asf")) << ran.err;
  file("07_0.asf", small_asf());
  EXPECT_EQ(contort_program({"check", amc}).code, 1) << "a longer common beginning";
  file("07_02.asf", small_asf());
  ran = contort_program({"check", amc});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(has(ran.err, "check.no_skeleton: more than one")) << ran.err;
  EXPECT_EQ(contort_program({"check", amc, "--skeleton", folder_ / "anything.asf"}).code, 1);
}

TEST_F(CheckClips, AMapBringsTheLimitsOfACharacter) {
  // 400 deg/s at first, then slower; the human's elbow may turn faster than 100 deg/s and slower than 2000.
  const std::string slow = file("slow.bvh", bvh_of("rig:Left Arm", {0, 4, 8, 11, 13, 14}));
  const std::string fast = file("fast.bvh", bvh_of("rig:Left Arm", {0, 20, 40, 60, 80, 100}));
  const std::string map =
      file("map.json", R"({"format": "contort.map/1", "joints": {"rig:Left Arm": "arm_left/elbow"}})");
  const auto check = [&](const std::string& path, const std::string& max) {
    return contort_program({"check", path, "--character", "human", "--map", map, "--max-speed-deg-s", max});
  };
  EXPECT_EQ(check(slow, "100").code, 0) << "the character's limit holds, not the general one";
  EXPECT_EQ(check(fast, "3000").code, 1);
  const Ran unmapped = contort_program({"check", fast, "--character", "human"});
  EXPECT_EQ(unmapped.code, 2) << "names do not match without a map";
  EXPECT_TRUE(has(unmapped.err, "check.nothing_matches: ") && has(unmapped.err, "nodes are rig:Left Arm"))
      << unmapped.err;
  const Ran alone = contort_program({"check", fast, "--map", map});
  EXPECT_EQ(alone.code, 2);
  EXPECT_TRUE(has(alone.err, "--character")) << alone.err;
}

TEST_F(CheckClips, AMapThatFitsNothingIsRefused) {
  const std::string take = file("take.bvh", bvh_of("arm", {0, 1, 2}));
  const auto refused = [&](const std::string& joints) {
    const std::string map = file("map.json", R"({"format": "contort.map/1", "joints": )" + joints + "}");
    const Ran ran = contort_program({"check", take, "--character", "human", "--map", map});
    EXPECT_EQ(ran.code, 2) << joints;
    EXPECT_EQ(ran.out, "");
    return ran.err;
  };
  EXPECT_TRUE(has(refused(R"({"arm": "arm_left/elbo"})"), "map.unknown_joint at /joints/arm: "));
  EXPECT_TRUE(
      has(refused(R"({"leg": "arm_left/elbow"})"), "map.unknown_node at /joints/leg: " + (folder_ / "map.json")));
  EXPECT_TRUE(has(refused("[]"), "map.wrong_type at /joints: "));
}

TEST_F(CheckClips, AllClipsAreOneLineEachWorstFirst) {
  file("b/calm.bvh", bvh_of("arm", {0, 1, 2}));
  file("b/c/wild.BVH", bvh_of("arm", {0, 50, 100, 150}));
  file("a.bvh", bvh_of("arm", {0, 2, 4}));
  file("b/broken.bvh", "x");
  file("b/readme.txt", "not an animation");
  const Ran ran = contort_program({"check", folder_.path(), "--all-clips", "--allow-unreadable"});
  EXPECT_EQ(ran.code, 1) << ran.err;
  const std::vector<std::string> lines = lines_of(ran.out);
  ASSERT_EQ(lines.size(), 16U) << ran.out;
  EXPECT_TRUE(has(lines[0], "wild.BVH: clip wild: findings 1, pops 0, peak 5000.0 deg/s at arm, ")) << lines[0];
  EXPECT_TRUE(has(lines[1], "a.bvh: clip a: findings 0")) << lines[1];
  EXPECT_TRUE(has(lines[2], "calm.bvh: clip calm: findings 0")) << lines[2];
  EXPECT_TRUE(has(lines[3], "broken.bvh: unreadable: bvh.bad_syntax at line 1: ")) << lines[3];
  EXPECT_EQ(lines[4], "Judged: 5 checks on 1 channel, in 3 motions");
  EXPECT_EQ(lines[15], "RESULT findings=1 clips=3 files=4 unreadable=1");
  EXPECT_TRUE(has(ran.err, "clips per second")) << ran.err;
  EXPECT_FALSE(has(ran.out, "clips per second"));
}

TEST_F(CheckClips, AllClipsAsJsonNameTheirFiles) {
  const std::string good = file("good.bvh", bvh_of("arm", {0, 1, 2}));
  const std::string bad = file("bad.bvh", "x");
  const Ran ran = contort_program({"check", good, bad, "--all-clips", "--json"});
  EXPECT_EQ(ran.code, 2) << ran.err;
  const Json out = Json::parse(ran.out, nullptr, false);
  ASSERT_TRUE(out.is_object()) << ran.out;
  EXPECT_EQ(out["clips"][0]["file"], good);
  EXPECT_NEAR(out["clips"][0]["least_margin_deg_s"].get<double>(), 2900.0, 1e-6);
  EXPECT_EQ(out["unreadable"][0]["file"], bad);
  EXPECT_EQ(out["unreadable"][0]["code"], "bvh.bad_syntax");
  EXPECT_EQ(out["unreadable"][0]["pointer"], "line 1");
}

TEST_F(CheckClips, FilesThatCannotBeReadFailTheCheckWithACountAndAList) {
  file("a/good.bvh", bvh_of("arm", {0, 1}));
  file("a/bad.bvh", "x");
  file("a/below/picture.glb", "\x89PNG\r\n\x1a\n");
  const Ran ran = contort_program({"check", folder_ / "a", "--all-clips"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(has(ran.err, "check.unreadable: 2 of 3 files cannot be read")) << ran.err;
  EXPECT_TRUE(has(ran.out, "bad.bvh: unreadable: bvh.bad_syntax")) << ran.out;
  EXPECT_TRUE(has(ran.out, "picture.glb is a PNG image")) << ran.out;
  EXPECT_TRUE(has(ran.out, "FAILED: 2 of 3 files cannot be read.")) << ran.out;
  EXPECT_FALSE(has(ran.out, "OK")) << ran.out;
  EXPECT_EQ(last_line(ran.out), "RESULT findings=0 clips=1 files=3 unreadable=2");
  file("a/wild.bvh", bvh_of("arm", {0, 50, 100, 150}));
  const Ran both = contort_program({"check", folder_ / "a", "--all-clips"});
  EXPECT_EQ(both.code, 2) << "what was not looked at says more than what was found";
  EXPECT_TRUE(has(both.out, "FAILED: limits are violated, and 2 of 4 files cannot be read.")) << both.out;
}

TEST_F(CheckClips, PipesAndLinksToNothingInAFolderAreFilesThatCannotBeRead) {
  file("good.bvh", bvh_of("arm", {0, 1}));
  ASSERT_EQ(::mkfifo((folder_ / "pipe.glb").c_str(), 0600), 0);
  std::filesystem::create_symlink(folder_ / "gone.bvh", folder_ / "link.bvh");
  const Ran ran = contort_program({"check", folder_.path(), "--all-clips"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(has(ran.out, "pipe.glb is a named pipe")) << ran.out;
  EXPECT_EQ(last_line(ran.out), "RESULT findings=0 clips=1 files=3 unreadable=2");
}

TEST_F(CheckClips, OnlyWhereNothingCanBeReadAllowedFilesAreBadInput) {
  const std::string bad = file("bad.bvh", "x");
  EXPECT_EQ(contort_program({"check", bad, "--all-clips", "--allow-unreadable"}).code, 2);
  const std::string good = file("good.bvh", bvh_of("arm", {0, 1}));
  const Ran allowed = contort_program({"check", bad, good, "--all-clips", "--allow-unreadable"});
  EXPECT_EQ(allowed.code, 0) << allowed.err;
  EXPECT_TRUE(has(allowed.out, "OK: nothing found.")) << allowed.out;
  EXPECT_TRUE(has(allowed.out, "bad.bvh: unreadable: ")) << allowed.out;
  EXPECT_EQ(contort_program({"check", good, "--allow-unreadable"}).code, 2) << "it is for --all-clips";
  const Ran empty =
      contort_program({"check", file("empty/x.txt", "").substr(0, folder_.path().size() + 6), "--all-clips"});
  EXPECT_EQ(empty.code, 2);
  EXPECT_TRUE(has(empty.err, "check.no_clip")) << empty.err;
}

// A file may have keys 1e-300 s apart, whose speed would have 300 digits. A display shows at most 240 frames a second.
TEST_F(CheckClips, KeysANanosecondApartAreJudgedAsADisplayShowsThem) {
  const std::string text = replaced(bvh_of("arm", {0, 1, 2}), "Frame Time: 0.01", "Frame Time: 1e-9");
  const Ran ran = contort_program({"check", file("a.bvh", text)});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(has(ran.out, "peak 480.0 deg/s at arm")) << ran.out;
  EXPECT_TRUE(has(ran.out, "remark: Frame Time: says 1e-09 s")) << ran.out;
}

TEST_F(CheckClips, FilesOfOtherKindsInAFolderAreNamed) {
  file("mixed/a.bvh", bvh_of("arm", {0, 1}));
  file("mixed/b.dat", bvh_of("arm", {0, 1}));  // the contents decide, not the name
  file("mixed/c.fbx", "Kaydara FBX Binary  ");
  file("mixed/readme.txt", "hello");
  const Ran ran = contort_program({"check", folder_ / "mixed", "--all-clips"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(has(ran.out, "clips=2 files=2 unreadable=0 skipped=1")) << ran.out;
  EXPECT_TRUE(has(ran.out, "c.fbx is an FBX model")) << ran.out;
  EXPECT_FALSE(has(ran.out, "readme")) << ran.out;
  const Ran json = contort_program({"check", folder_ / "mixed", "--all-clips", "--json"});
  EXPECT_TRUE(has(json.out, "\"skipped\": [")) << json.out;
}

TEST_F(CheckClips, OptionsOfBvhAreForBvh) {
  const std::string bvh = file("a.bvh", bvh_of("arm", {0, 1, 2}));
  const Ran slow = contort_program({"check", bvh, "--rate-hz", "1", "--unit", "cm", "--up", "z"});
  EXPECT_EQ(slow.code, 0) << slow.err;
  EXPECT_TRUE(has(slow.out, "the frames are read at 1 per second instead")) << slow.out;
  EXPECT_EQ(contort_program({"check", bvh, "--unit", "mile"}).code, 2);
  const Ran other = contort_program({"check", file("a.glb", "glTF"), "--unit", "cm"});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(has(other.err, "usage.for_bvh")) << other.err;
}

TEST_F(CheckClips, SeveralFilesNeedAllClips) {
  const std::string path = file("take.bvh", bvh_of("arm", {0, 1, 2}));
  const Ran ran = contort_program({"check", path, path});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(has(ran.err, "--all-clips")) << ran.err;
  EXPECT_EQ(contort_program({"check", path, "--all-clips", "--clip", "take"}).code, 2);
}

TEST_F(CheckClips, NamesCannotWriteToTheTerminal) {
  const Ran ran = contort_program({"check", file("take.bvh", bvh_of("a\x1b[31mm", {0, 1, 2}))});
  EXPECT_EQ(ran.code, 0);
  EXPECT_FALSE(has(ran.out, "\x1b"));
  EXPECT_TRUE(has(ran.out, "a?[31mm")) << ran.out;
}

}  // namespace
}  // namespace contort
