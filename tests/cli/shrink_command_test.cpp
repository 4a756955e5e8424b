// contort shrink, as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/corpus/sample_cases.h"

namespace contort {

namespace {

class ShrinkCommand : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    spill(folder_ / name, text);
    return folder_ / name;
  }
  TempFolder folder_;
};

TEST_F(ShrinkCommand, WritesASmallerCaseThatReplaysAsTheSame) {
  const std::string stored = file("case.json", print_case(elbow_case(270, 77)));
  const std::string smaller = folder_ / "small.json";
  const Ran ran = contort_program({"shrink", stored, "-o", smaller});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(contort_program({"replay", smaller}).code, 1);
  EXPECT_LT(print_spec(read_case(smaller)->spec).size(), print_spec(bent_elbow(270, 77)).size());
  Case passes = elbow_case();
  passes.spec = bent_elbow(100);
  const Ran none = contort_program({"shrink", file("passes.json", print_case(passes)), "-o", smaller});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("shrink.no_failure"), std::string::npos) << none.err;
}

TEST_F(ShrinkCommand, AgainWritesTheSameFile) {
  const std::string first = folder_ / "first.json", second = folder_ / "second.json", worst = folder_ / "worst.json";
  ASSERT_EQ(contort_program({"shrink", file("case.json", print_case(elbow_case(270, 77))), "-o", first}).code, 0);
  const Ran again = contort_program({"shrink", first, "-o", second, "--worst", worst});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(slurp(first), slurp(second));
  EXPECT_NE(again.out.find("worst: "), std::string::npos) << again.out;
  EXPECT_NE(contort_program({"replay", worst}).out.find("still fails"), std::string::npos);
}

// The arm swings through the body: the hand that touches a thigh is the least of it.
TEST_F(ShrinkCommand, KeepsTheFamilyAndSaysUnderWhichARunFilesIt) {
  const ActionUse across = pose_use("arm_left", {{"shoulder_deg", Vec3(0, 0, -50)}, {"elbow_deg", 20.0}}, 40);
  const Case stored = failing_case(spec_of({across}), "self_collision", "hand_left/hand ~ leg_right/thigh");
  const std::string smaller = folder_ / "small.json", given = file("case.json", print_case(stored));
  const Ran ran = contort_program({"shrink", given, "-o", smaller});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(family_of(*read_case(smaller)), family_of(stored));
  const nlohmann::json said =
      nlohmann::json::parse(contort_program({"shrink", given, "-o", smaller, "--json"}).out, nullptr, false);
  ASSERT_TRUE(said["precursor"].is_string()) << said;
  const std::string precursor = said["precursor"];
  EXPECT_NE(ran.out.find("a run files it under: " + precursor + "\n"), std::string::npos) << ran.out;
  EXPECT_NE(precursor, print_family(family_of(stored)));
}

// The profile requires at least 120 frames; the case has 150.
TEST_F(ShrinkCommand, StaysWithinTheProfileThatFoundTheCase) {
  Case stored = elbow_case(270, 150);
  const auto frames_of = [&](const std::vector<std::string>& more, std::string* said = nullptr) {
    std::vector<std::string> call = {"shrink", file("case.json", print_case(stored)), "-o", folder_ / "min.json"};
    call.insert(call.end(), more.begin(), more.end());
    const Ran ran = contort_program(call);
    EXPECT_EQ(ran.code, 0) << ran.err;
    if (said != nullptr) *said = ran.err;
    return read_case(folder_ / "min.json")->spec.sequences[0].clips[0].actions[0].duration_frames;
  };
  EXPECT_EQ(frames_of({}), 30);
  EXPECT_GE(frames_of({"--profile", "tame"}), 120);
  stored.provenance.profile = "tame";
  EXPECT_GE(frames_of({}), 120);
  const std::string longer =
      file("longer.json", R"({"format": "contort.profile/1", "name": "mine", "shortest_frames": 140,
                                                     "longest_frames": 200})");
  EXPECT_GE(frames_of({"--profile", longer}), 140);
  stored.provenance.profile = "mine";
  std::string said;
  EXPECT_EQ(frames_of({}, &said), 30);
  EXPECT_NE(said.find("\"mine\""), std::string::npos) << said;
  const Ran unknown = contort_program({"shrink", file("case.json", print_case(stored)), "--profile", "nothing"});
  EXPECT_NE(unknown.code, 0);
  EXPECT_NE(unknown.err.find("profile.unknown"), std::string::npos) << unknown.err;
}

TEST_F(ShrinkCommand, TellsAScriptWhatItDid) {
  const std::string smaller = folder_ / "small.json";
  const Ran ran = contort_program({"shrink", file("case.json", print_case(elbow_case(270))), "-o", smaller, "--json"});
  const nlohmann::json told = nlohmann::json::parse(ran.out);
  EXPECT_EQ(told["case"], smaller);
  EXPECT_EQ(told["family"], "joint_range|human|arm_left/elbow max");
  EXPECT_EQ(told["stopped"], "fixpoint");
  EXPECT_GT(told["evaluations"], 2);
  EXPECT_GT(told["worst_depth"], told["depth"]);
}

}  // namespace

}  // namespace contort
