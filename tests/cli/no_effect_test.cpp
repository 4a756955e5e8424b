// Options, patterns and rules without effect are errors that list the possible values.
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace contort {
namespace {

// A hip and a knee that turn about Z, 30 keys a second.
std::string leg_bvh(const std::vector<double>& knee_deg) {
  std::string text =
      "HIERARCHY\nROOT hip\n{\nOFFSET 0 0 0\nCHANNELS 1 Zrotation\nJOINT knee\n{\nOFFSET 0 -40 0\nCHANNELS 1 "
      "Zrotation\nEnd Site\n{\nOFFSET 0 -40 0\n}\n}\n}\nMOTION\nFrames: " +
      std::to_string(knee_deg.size()) + "\nFrame Time: 0.0333333\n";
  for (const double angle : knee_deg) text += "0 " + std::to_string(angle) + "\n";
  return text;
}

class NoEffect : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    spill(folder_ / name, text);
    return folder_ / name;
  }
  std::string walk() const { return file("walk.bvh", leg_bvh({0, 1, 2, 3, 2, 1, 0})); }

  // Returns the message on standard error. The code must be 2, and standard output empty.
  static std::string refusal(const std::vector<std::string>& arguments) {
    const Ran ran = contort_program(arguments);
    EXPECT_EQ(ran.code, 2) << ran.out;
    EXPECT_EQ(ran.out, "");
    return ran.err;
  }
  std::string rule(const std::string& check, const std::string& subject) const {
    return file("rules.json", R"({"format": "contort.settings/1", "limits": [{"check": ")" + check +
                                  R"(", "subject": ")" + subject + R"(", "tolerance": 0.1, "reason": "r"}]})");
  }
  TempFolder folder_;
};

bool tells(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

TEST_F(NoEffect, APatternOfLoopsThatMatchesNoClip) {
  const std::string said = refusal({"check", walk(), "--loops", "wlak*"});
  EXPECT_TRUE(tells(said, "check.no_effect: --loops \"wlak*\" matches no clip; there are walk; did you mean \"walk\"?"))
      << said;
  EXPECT_TRUE(tells(refusal({"check", walk(), "--loops", "walk", "--loops", "run"}), "\"run\"")) << "each is asked";
  EXPECT_EQ(contort_program({"check", walk(), "--loops", "walk", "--loops", "w*"}).code, 0);
}

TEST_F(NoEffect, AClipThatIsNotThere) {
  const std::string said = refusal({"check", walk(), "--clip", "wakl"});
  EXPECT_TRUE(tells(said, "check.no_clip") && tells(said, "did you mean \"walk\"?")) << said;
}

TEST_F(NoEffect, ASkeletonWithoutATake) {
  EXPECT_TRUE(tells(refusal({"check", walk(), "--skeleton", "nowhere.asf"}), "check.no_effect: --skeleton"));
}

TEST_F(NoEffect, AGapOfJointsThatHaveNoPlaces) {
  const std::string lone = file("lone.bvh",
                                "HIERARCHY\nROOT arm\n{\nOFFSET 0 0 0\nCHANNELS 1 Zrotation\n}\nMOTION\nFrames: 3\n"
                                "Frame Time: 0.01\n0\n1\n2\n");
  EXPECT_TRUE(tells(refusal({"check", lone, "--max-gap-m", "0.01"}), "check.no_effect: --max-gap-m"));
}

TEST_F(NoEffect, ARuleForASubjectThatIsNotThere) {
  const std::string said = refusal({"check", walk(), "--settings", rule("pop", "kene")});
  EXPECT_TRUE(tells(said, "check.no_effect at /limits/0") && tells(said, "did you mean \"knee\"?")) << said;
  EXPECT_EQ(contort_program({"check", walk(), "--settings", rule("pop", "kn*")}).code, 0);
  EXPECT_TRUE(tells(refusal({"check", walk(), "--settings", rule("balance", "*")}), "/limits/0"))
      << "a check that judges no clip";
}

TEST_F(NoEffect, AFolderIsCheckedWithoutAFurtherWord) {
  walk();
  const Ran ran = contort_program({"check", folder_.path()});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(last_line(ran.out), "RESULT findings=0 clips=1 files=1 unreadable=0");
  EXPECT_TRUE(tells(refusal({"check", walk(), "--allow-unreadable"}), "usage.for_folders"));
}

TEST_F(NoEffect, AFileOfWhichNothingIsJudged) {
  EXPECT_TRUE(tells(refusal({"check", file("pose.bvh", leg_bvh({5}))}), "check.nothing_judged"));
}

}  // namespace
}  // namespace contort
