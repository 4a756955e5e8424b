// contort check --report, as a user runs it; and clips that are judged by the feet of their own skeleton.
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/mocap/asf_text.h"

namespace contort {
namespace {

bool holds_text(const std::string& text, const std::string& what) { return text.find(what) != text.npos; }

// Two legs that stand, and move to the side by this many centimetres in each of 60 frames.
std::string standing_bvh(double step_cm, double sinks_cm = 0.0) {
  std::string text = "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
                     "Yrotation\n";
  for (const char* side : {"Left", "Right"}) {
    const std::string turns = "CHANNELS 3 Zrotation Xrotation Yrotation\n", name = side;
    text += "JOINT " + name + "UpLeg\n{\nOFFSET " + (name == "Left" ? "10" : "-10") + " 0 0\n" + turns;
    text += "JOINT " + name + "Leg\n{\nOFFSET 0 -45 0\n" + turns + "JOINT " + name + "Foot\n{\nOFFSET 0 -40 0\n" + turns;
    text += "JOINT " + name + "Toe\n{\nOFFSET 0 -5 12\n" + turns + "End Site\n{\nOFFSET 0 0 5\n}\n}\n}\n}\n}\n";
  }
  text += "}\nMOTION\nFrames: 60\nFrame Time: 0.033333\n";
  for (int frame = 0; frame < 60; ++frame) {
    text += std::to_string(step_cm * frame) + " " + std::to_string(90.0 - sinks_cm * frame) + " 0";
    for (int turn = 0; turn < 27; ++turn) text += " 0";
    text += "\n";
  }
  return text;
}

class ClipsReport : public testing::Test {
 protected:
  ClipsReport() {
    std::filesystem::create_directories(folder_ / "clips");
    spill(folder_ / "clips/still.bvh", standing_bvh(0.0));
    spill(folder_ / "clips/glides.bvh", standing_bvh(1.5));
  }
  Ran check(const std::vector<std::string>& more) const {
    std::vector<std::string> call = {"check", folder_ / "clips", "--report", page()};
    call.insert(call.end(), more.begin(), more.end());
    return contort_program(call);
  }
  std::string page() const { return folder_ / "page"; }
  TempFolder folder_;
};

TEST_F(ClipsReport, ShowsTheWorstClipsWithTheirPose) {
  const Ran ran = check({});
  EXPECT_EQ(ran.code, 1) << ran.out << ran.err;
  EXPECT_TRUE(holds_text(ran.out, "report: " + page() + "/index.html\n")) << ran.out;
  const std::string html = slurp(page() + "/index.html");
  for (const std::string part : {"1 of 2 clips have findings", "<svg", "Foot slides: LeftFoot", "All findings: foot_slide 2",
                                 "glides.bvh --clip glides", "still.bvh: still"})
    EXPECT_TRUE(holds_text(html, part)) << part;
  EXPECT_EQ(check({}).code, 1) << "the page is its own";
  EXPECT_EQ(slurp(page() + "/index.html"), html);
  EXPECT_FALSE(holds_text(check({"--json"}).out, "report:"));
}

TEST_F(ClipsReport, DrawsTheCharacterThatIsJudged) {
  spill(folder_ / "clips/tiny.asf", small_asf());
  spill(folder_ / "clips/tiny_01.amc", small_amc());
  ASSERT_EQ(contort_program({"import", folder_ / "clips/tiny.asf", "-o", folder_ / "people"}).code, 0);
  const Ran ran = contort_program({"--library", folder_ / "people", "check", folder_ / "clips/tiny_01.amc", "--character",
                                   "tiny", "--report", page()});
  EXPECT_EQ(ran.code, 1) << ran.err;
  const std::string html = slurp(page() + "/index.html");
  EXPECT_TRUE(holds_text(html, "judged as motions of tiny"));
  EXPECT_TRUE(holds_text(html, "<svg") && holds_text(html, "class='marked'"));
  EXPECT_TRUE(holds_text(html, "--character tiny"));
}

TEST_F(ClipsReport, IsNotMixedIntoOtherPeoplesFiles) {
  std::filesystem::create_directories(page());
  spill(page() + "/index.html", "<title>My page</title>");
  const Ran ran = check({});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(holds_text(ran.err, "folder.other_files")) << ran.err;
  EXPECT_EQ(contort_program({"check", "docs/examples/reach_hand.json", "--report", folder_ / "other"}).code, 2)
      << "a spec is no clip";
}

TEST_F(ClipsReport, FeetAreTheFilesOwnWithoutACharacter) {
  const Ran ran = contort_program({"check", folder_ / "clips/glides.bvh"});
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_TRUE(holds_text(ran.out, "  foot_slide  LeftFoot  slides on the ground by ")) << ran.out;
  EXPECT_EQ(contort_program({"check", folder_ / "clips/still.bvh"}).code, 0);
  const Ran unnamed = contort_program({"check", [&] {
    std::string text = standing_bvh(1.5);
    for (std::size_t at = text.find("Foot"); at != text.npos; at = text.find("Foot")) text.replace(at, 4, "Part");
    spill(folder_ / "unnamed.bvh", text);
    return folder_ / "unnamed.bvh";
  }()});
  EXPECT_EQ(unnamed.code, 0) << unnamed.out;
  EXPECT_TRUE(holds_text(unnamed.out, "foot_slide could not judge: the names of its nodes tell no two feet")) << unnamed.out;
}

TEST_F(ClipsReport, AFigureThatSinksAsAWholeIsAFinding) {
  spill(folder_ / "sinks.bvh", standing_bvh(0.0, 0.4));  // 24 cm in two seconds
  const Ran ran = contort_program({"check", folder_ / "sinks.bvh"});
  EXPECT_EQ(ran.code, 1) << ran.out << ran.err;
  EXPECT_TRUE(holds_text(ran.out, "  ground_penetration  ")) << ran.out;
  EXPECT_TRUE(holds_text(ran.out, "goes up or down with the whole figure by ")) << ran.out;
  EXPECT_FALSE(holds_text(ran.out, "ground_penetration could not judge")) << ran.out;
  spill(folder_ / "breathes.bvh", standing_bvh(0.0, 0.02));
  EXPECT_EQ(contort_program({"check", folder_ / "breathes.bvh"}).code, 0);
}

}  // namespace
}  // namespace contort
