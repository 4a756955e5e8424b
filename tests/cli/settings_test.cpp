// --settings, --today and --loops, as a user has them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/spec/spec.h"
#include "tests/cli/program.h"
#include "tests/corpus/sample_cases.h"

namespace contort {
namespace {

using Json = nlohmann::json;

class SettingsOfCommands : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) {
    spill(folder_ / name, bytes);
    return folder_ / name;
  }
  // An elbow that bends too far.
  std::string spec() { return file("spec.json", pretty_spec(bent_elbow(154))); }
  std::string waiver(const std::string& check) {
    return file("settings.json", R"({"format": "contort.settings/1", "waivers": [{"check": ")" + check +
                                     R"(", "reason": "ticket 12", "owner": "ana", "expires": "2027-03-01"}]})");
  }
  TempFolder folder_;
};

bool says(const Ran& ran, const std::string& text) { return ran.out.find(text) != std::string::npos; }

TEST_F(SettingsOfCommands, AWaiverHidesUntilItsDayAndIsAlwaysTold) {
  const std::string settings = waiver("joint_range");
  const Ran plain = contort_program({"check", spec()});
  ASSERT_EQ(plain.code, 1) << plain.out;
  ASSERT_TRUE(says(plain, "RESULT findings=1\n")) << plain.out;
  const Ran hidden = contort_program({"check", spec(), "--settings", settings, "--today", "2027-03-01"});
  EXPECT_EQ(hidden.code, 0) << hidden.out << hidden.err;
  EXPECT_TRUE(says(hidden, "waived: 1 by waiver 0") && says(hidden, "RESULT findings=0 waived=1")) << hidden.out;
  const Ran expired = contort_program({"check", spec(), "--settings", settings, "--today", "2027-03-02"});
  EXPECT_EQ(expired.code, 1) << expired.out;
  EXPECT_TRUE(says(expired, "EXPIRED: waiver 0")) << expired.out;
  const Ran useless = contort_program({"check", spec(), "--settings", waiver("pop"), "--today", "2027-03-01"});
  EXPECT_EQ(useless.code, 1) << useless.out;
  EXPECT_TRUE(says(useless, "USELESS: waiver 0")) << useless.out;
}

TEST_F(SettingsOfCommands, WhatIsWaivedIsInTheJson) {
  const Ran ran =
      contort_program({"check", spec(), "--settings", waiver("joint_range"), "--today", "2027-03-01", "--json"});
  const Json out = Json::parse(ran.out, nullptr, false);
  ASSERT_TRUE(out.is_object()) << ran.out;
  EXPECT_TRUE(out["findings"].empty());
  EXPECT_EQ(out["waivers"][0]["state"], "used");
  EXPECT_EQ(out["waivers"][0]["findings"], 1);
}

// A waived fault is not repaired.
TEST_F(SettingsOfCommands, ReplayDoesNotTakeAWaivedFailureForMended) {
  const std::string corpus = folder_ / "corpus";
  const Ran found = contort_program({"fuzz", "--profile", "stress", "--cases", "1", "--seed", "7", "--character", "human", "--corpus", corpus,
                                     "--shrinks-per-family", "1", "--shrink-evaluations", "0"});
  ASSERT_EQ(found.code, 1) << found.out << found.err;
  std::string waivers;
  for (const char* check : {"joint_range", "angular_velocity", "self_collision", "pop", "angular_acceleration"})
    waivers += std::string(waivers.empty() ? "" : ", ") + R"({"check": ")" + check +
               R"(", "reason": "r", "owner": "o", "expires": "2099-01-01"})";
  const std::string settings = file("all.json", R"({"format": "contort.settings/1", "waivers": [)" + waivers + "]}");
  const Ran replayed = contort_program({"replay", corpus, "--settings", settings});
  EXPECT_EQ(replayed.code, 1) << replayed.out;
  EXPECT_TRUE(says(replayed, "different=0 passes=0 refused=0")) << replayed.out;
}

TEST_F(SettingsOfCommands, BadSettingsAndDaysAreOneLine) {
  for (const std::string& path : {folder_ / "nowhere.json", file("bad.json", "{"), waiver("joint_rage")}) {
    const Ran ran = contort_program({"check", spec(), "--settings", path});
    EXPECT_EQ(ran.code, 2) << path;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
  EXPECT_EQ(contort_program({"check", spec(), "--today", "2027-02-29"}).code, 2);
}

TEST_F(SettingsOfCommands, AClipThatIsALoopMustClose) {
  const std::string glb = folder_ / "motion.glb";
  ASSERT_EQ(contort_program({"generate", spec(), "-o", glb}).code, 0);
  EXPECT_FALSE(says(contort_program({"check", glb}), "  loop_seam  "));
  const Ran loop = contort_program({"check", glb, "--loops", "*"});
  EXPECT_EQ(loop.code, 1) << loop.out;
  EXPECT_TRUE(says(loop, "  loop_seam  ")) << loop.out;
  const std::string settings = file("limits.json", R"({"format": "contort.settings/1", "limits": [{"check": "loop_seam",
      "use": "ignore", "reason": "no loop"}]})");
  EXPECT_FALSE(says(contort_program({"check", glb, "--loops", "*", "--settings", settings}), "  loop_seam  "));
}

TEST_F(SettingsOfCommands, ChecksOfClipsAreListedAndMayBeNamed) {
  const Ran list = contort_program({"list", "checks"});
  for (const char* name : {"loop_seam", "part_gap"}) EXPECT_TRUE(says(list, name)) << list.out;
  const std::string glb = folder_ / "motion.glb";
  ASSERT_EQ(contort_program({"generate", spec(), "-o", glb}).code, 0);
  const std::string settings = file("gaps.json", R"({"format": "contort.settings/1", "limits": [{"check": "part_gap",
      "use": "ignore", "reason": "stretches"}]})");
  const Ran judged = contort_program({"check", glb, "--max-gap-m", "0", "--settings", settings});
  EXPECT_NE(judged.code, 2) << judged.err;
  EXPECT_FALSE(says(judged, "  part_gap  ")) << judged.out;
  EXPECT_EQ(contort_program({"check", glb, "--max-gap-m", "nan"}).code, 2);
  EXPECT_EQ(contort_program({"check", glb, "--max-gap-m", "-1"}).code, 2);
}

}  // namespace
}  // namespace contort
