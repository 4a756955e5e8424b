// A library of clips at once: known findings that fail no run, threads, and names with other prefixes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace contort {
namespace {

using Json = nlohmann::json;

// One joint that turns about Z, 30 keys a second.
std::string one_joint_bvh(const std::vector<double>& angles_deg) {
  std::string text = "HIERARCHY\nROOT arm\n{\nOFFSET 0 0 0\nCHANNELS 1 Zrotation\n}\nMOTION\nFrames: " +
                     std::to_string(angles_deg.size()) + "\nFrame Time: 0.0333333\n";
  for (const double angle : angles_deg) text += std::to_string(angle) + "\n";
  return text;
}

const std::vector<double> kCalm = {0, 1, 2, 3, 4, 5, 6, 7};
const std::vector<double> kBlip = {0, 1, 2, 3, 40, 5, 6, 7};

class AcceptLists : public testing::Test {
 protected:
  void clip(const std::string& name, const std::vector<double>& angles_deg) const {
    std::filesystem::create_directories(std::filesystem::path(library() + "/" + name).parent_path());
    spill(library() + "/" + name, one_joint_bvh(angles_deg));
  }
  std::string library() const { return folder_ / "clips"; }
  std::string list() const { return folder_ / "known.json"; }
  TempFolder folder_;
};

TEST_F(AcceptLists, WhatIsWrittenIsAcceptedAndWhatIsMendedIsTold) {
  clip("a/look.bvh", kBlip);
  clip("b.bvh", kCalm);
  EXPECT_EQ(contort_program({"check", library(), "--write-accept-list", list()}).code, 1);
  const Json written = Json::parse(slurp(list()), nullptr, false);
  ASSERT_EQ(written["accepted"].size(), 1U) << written;
  EXPECT_EQ(written["accepted"][0]["file"], "a/look.bvh");
  EXPECT_EQ(written["accepted"][0]["clip"], "look");
  EXPECT_EQ(written["accepted"][0]["check"], "pop");
  EXPECT_EQ(written["accepted"][0]["joint"], "arm");
  const Ran known = contort_program({"check", library(), "--accept-list", list()});
  EXPECT_EQ(known.code, 0) << known.out;
  EXPECT_EQ(last_line(known.out), "RESULT findings=0 clips=2 accepted=1 files=2 unreadable=0");
  clip("b.bvh", kBlip);
  EXPECT_EQ(contort_program({"check", library(), "--accept-list", list()}).code, 1) << "the same in another file";
  clip("a/look.bvh", kCalm);
  clip("b.bvh", kCalm);
  const Ran mended = contort_program({"check", library(), "--accept-list", list()});
  EXPECT_EQ(mended.code, 0);
  EXPECT_NE(mended.out.find("accepted, and not found: a/look.bvh: clip look: pop at arm"), std::string::npos)
      << mended.out;
}

TEST_F(AcceptLists, ABrokenListIsRefused) {
  clip("b.bvh", kCalm);
  spill(list(), R"({"format": "contort.accept/1", "accepted": [{"file": "b.bvh"}]})");
  const Ran ran = contort_program({"check", library(), "--accept-list", list()});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("/accepted/0"), std::string::npos) << ran.err;
}

TEST_F(AcceptLists, ThreadsChangeNothing) {
  for (int i = 0; i < 20; ++i) clip(std::to_string(i) + ".bvh", i % 3 == 0 ? kBlip : kCalm);
  const Ran one = contort_program({"check", library(), "--jobs", "1"});
  EXPECT_EQ(one.code, 1);
  EXPECT_EQ(contort_program({"check", library(), "--jobs", "4"}).out, one.out);
}

TEST_F(AcceptLists, TheSchemaIsPublished) {
  EXPECT_EQ(slurp(std::string(CONTORT_SOURCE_DIR) + "/docs/schema/accept.schema.json"),
            contort_program({"schema", "accept"}).out);
}

TEST_F(AcceptLists, AMapMeansNamesWithAnotherPrefixToo) {
  spill(folder_ / "take.bvh",
        "HIERARCHY\nROOT new:Arm\n{\nOFFSET 0 0 0\nCHANNELS 1 Zrotation\nJOINT new:ForeArm\n{\nOFFSET 0 -1 0\n"
        "CHANNELS 1 Xrotation\n}\n}\nMOTION\nFrames: 3\nFrame Time: 0.0333333\n0 0\n1 1\n2 2\n");
  const auto judged_with = [&](const std::string& upper, const std::string& lower) {
    spill(folder_ / "map.json", R"({"format": "contort.map/1", "joints": {")" + upper +
                                    R"(": "arm_left/shoulder", ")" + lower + R"(": "arm_left/elbow"}})");
    return contort_program({"check", folder_ / "take.bvh", "--character", "human", "--map", folder_ / "map.json"});
  };
  const Ran similar = judged_with("old:Arm", "old:ForeArm");
  EXPECT_NE(similar.out.find("  2 nodes are those of the map with another prefix"), std::string::npos)
      << similar.out << similar.err;
  EXPECT_EQ(judged_with("old:Leg", "old:Shin").code, 2);
}

}  // namespace
}  // namespace contort
