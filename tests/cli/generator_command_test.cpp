// Programs under test as a user has them: contort generator check, and --generator with every command.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/cli/program.h"

namespace contort {
namespace {

using Json = nlohmann::json;

// A broken program, with its arguments: "moods crash".
std::string script(const std::string& words) {
  const std::size_t end = std::min(words.find(' '), words.size());
  return "/usr/bin/python3 " CONTORT_SOURCE_DIR "/tests/guest/broken/" + words.substr(0, end) + ".py" + words.substr(end);
}

// Returns only the lines about faults, and the notes.
std::string remarks_of(const std::string& out) {
  std::string remarks;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("FAULT: ") || line.starts_with("note: ")) remarks += line + "\n";
  return remarks;
}

TEST(GeneratorCheck, FindsNothingWrongWithAGoodProgram) {
  const Ran ran = contort_program({"generator", "check", script("good"), "--limits"});
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_EQ(remarks_of(ran.out), "");
  EXPECT_NE(ran.out.find("elbow                    0 to 100 degrees about its axis, at most 720 degrees/s"), std::string::npos)
      << ran.out;
  EXPECT_NE(ran.out.find("determinism: The same request gives the same bits"), std::string::npos);
  EXPECT_NE(ran.out.find("not judged: self_collision: no two bodies can collide: they are neighbours, or touch at rest"), std::string::npos);
}

TEST(GeneratorCheck, SaysWhichJointsFollowOthers) {
  const std::string follows = "  wrist follows elbow: 0.5 times its angle from rest, plus 0 degrees\n";
  const Ran good = contort_program({"generator", "check", script("follower 0.5")});
  EXPECT_EQ(good.code, 0) << good.out << good.err;
  EXPECT_NE(good.out.find(follows), std::string::npos) << good.out;
  EXPECT_NE(good.out.find("mimic_error"), std::string::npos) << good.out;
  EXPECT_EQ(remarks_of(good.out), "");
}

// Equal reasons are printed once, with the number of motions.
TEST(GeneratorCheck, CountsRefusedMotionsByTheirReason) {
  const std::string out = contort_program({"generator", "check", script("refuses")}).out;
  std::map<std::string, int> counts;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("refused: ")) continue;
    const std::string reason = line.substr(line.rfind(": ") + 2);
    EXPECT_EQ(counts.count(reason), 0U) << out;
    counts[reason] = std::atoi(line.c_str() + 9);
  }
  ASSERT_EQ(counts.size(), 2U) << out;
  EXPECT_GT(counts["the angle is too large"], 0) << out;
  EXPECT_GT(counts["there are too many swings"], 0) << out;
  EXPECT_LE(counts["the angle is too large"] + counts["there are too many swings"], 24) << out;
}

TEST(GeneratorCheck, TellsEachWayToBreakThePromisesInOneRightSentence) {
  const std::pair<std::string, std::string> expected[] = {
      {"banner", "FAULT: The generator writes something else than replies to its standard output after the manifest"},
      {"frame_count", "FAULT: A reply has another number of bytes than the frames that were asked for"},
      {"nan", "FAULT: Frames have NaN or infinite values"},
      {"quaternion_length", "FAULT: Quaternions do not have length 1"},
      {"axes", "are the axes and unit_m of the convention those of the frames?"},
      {"degrees", "is an angle in degrees used where radians are expected?"},
      {"state_leak", "FAULT: A request is answered differently after another one: state of an earlier request is left"},
      {"clock", "FAULT: Two fresh processes answer the same request differently"},
      {"crash", "FAULT: The generator ends while it makes a motion (exit 1). It printed: walker: the pool of clips is "
                "exhausted"},
      {"hang", "FAULT: The generator does not answer in time"},
      {"slow", "note: The generator makes "},
      {"lying_range", "FAULT: The generator fails for a request that its manifest allows."},
      {"lying_speed", " motions. Either the unit of max_speed_deg_s is wrong (degrees per second), or the motion is too fast"},
  };
  for (const auto& [name, sentence] : expected) {
    const Ran ran = contort_program({"generator", "check", script(name)});
    EXPECT_EQ(ran.code, name == "slow" ? 0 : 1) << name << "\n" << ran.out << ran.err;
    EXPECT_NE(remarks_of(ran.out).find(sentence), std::string::npos) << name << "\n" << ran.out << ran.err;
    EXPECT_TRUE(ran.out.ends_with(name == "slow" ? "OK: the generator keeps the protocol.\n" : "\n") &&
                (name == "slow" || ran.out.find("\nFAILED: ") != std::string::npos))
        << ran.out;
  }
}

TEST(GeneratorCheck, DoesNotSayTwiceThatTheGeneratorRefuses) {
  const std::string out = contort_program({"generator", "check", script("refuses")}).out;
  EXPECT_NE(out.find("but the generator refuses it: the angle is too large\n"), std::string::npos) << out;
}

class ProgramUnderTest : public testing::Test {
 protected:
  Ran fuzz(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"fuzz", "--generator", script(name), "--corpus", corpus(), "--jobs", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return contort_program(arguments);
  }
  std::string corpus() const { return folder_ / "corpus"; }
  std::vector<Json> minimal_cases() const {
    std::vector<Json> cases;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus() + "/buckets"))
      if (entry.path().filename().string().starts_with("min-")) cases.push_back(Json::parse(slurp(entry.path().string())));
    return cases;
  }
  TempFolder folder_;
};

TEST_F(ProgramUnderTest, IsCleanWhereItKeepsItsPromises) {
  const Ran ran = fuzz("good", {"--cases", "700"});
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_NE(ran.out.find("100 % of 700 cases are clean"), std::string::npos) << ran.out;
  EXPECT_EQ(ran.err, "");
}

TEST_F(ProgramUnderTest, WhoseJointDoesNotFollowItsLeaderIsFound) {
  const Ran ran = fuzz("follower 0.9", {"--cases", "60"});
  EXPECT_EQ(ran.code, 1) << ran.out << ran.err;
  const std::vector<Json> cases = minimal_cases();
  ASSERT_FALSE(cases.empty());
  for (const Json& found : cases) EXPECT_EQ(found["expect"]["check"], "mimic_error") << found["expect"];
}

TEST_F(ProgramUnderTest, ThatCrashesIsFoundWithItsLastWords) {
  EXPECT_EQ(fuzz("crash", {"--cases", "60"}).code, 1);
  const std::vector<Json> cases = minimal_cases();
  ASSERT_EQ(cases.size(), 1U);
  EXPECT_EQ(cases[0]["expect"]["check"], "crash");
  EXPECT_EQ(cases[0]["expect"]["subject"], "exit 1");
  EXPECT_EQ(cases[0]["expect"]["printed"], "walker: the pool of clips is exhausted ");
  EXPECT_EQ(cases[0]["provenance"]["generator"], "good");
  int uses = 0;
  for (const Json& sequence : cases[0]["spec"]["sequences"])
    for (const Json& clip : sequence["clips"]) uses += static_cast<int>(clip["actions"].size());
  EXPECT_EQ(uses, 2) << "two swings are enough: " << cases[0]["spec"];
}

TEST_F(ProgramUnderTest, ThatHangsIsFoundAndLeavesNothingBehind) {
  EXPECT_EQ(fuzz("hang", {"--cases", "6", "--case-timeout", "1", "--shrink-evaluations", "3"}).code, 1);
  const std::vector<Json> cases = minimal_cases();
  ASSERT_FALSE(cases.empty());
  EXPECT_EQ(cases[0]["expect"]["check"], "timeout");
}

TEST_F(ProgramUnderTest, ThatRefusesMotionsSaysWhyInTheSummaryAndOnThePage) {
  const Ran ran = fuzz("refuses", {"--cases", "400", "--report", folder_ / "report", "--gl", "none"});
  EXPECT_EQ(ran.code, 4) << ran.out << ran.err;
  EXPECT_NE(ran.out.find(" of 400 motions: the angle is too large\n"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find(" of 400 motions: there are too many swings\n"), std::string::npos) << ran.out;
  EXPECT_EQ(ran.out.find("100 % of 400 cases"), std::string::npos) << "what was refused is not clean: " << ran.out;
  EXPECT_LE(lines_of(ran.out).size(), 40U);
  const std::string page = slurp(folder_ / "report/index.html");
  EXPECT_NE(page.find(" of 400 motions: the angle is too large</li>"), std::string::npos);
  int refused = 0;
  const Json report = Json::parse(slurp(folder_ / "report/report.json"));
  for (const Json& reason : report["refusals"]) refused += reason["cases"].get<int>();
  const std::string last = "contort: the generator refused " + std::to_string(refused) + " of 400 requests";
  EXPECT_NE(ran.err.find(last), std::string::npos) << ran.err;
}

TEST_F(ProgramUnderTest, ThatRefusesEverythingWasNotTested) {
  const Ran ran = fuzz("moods refuse_all", {"--cases", "40", "--report", folder_ / "report", "--gl", "none"});
  EXPECT_EQ(ran.code, 4) << ran.out << ran.err;
  EXPECT_NE(ran.out.find("The generator refused every case, so that nothing was judged.\n"), std::string::npos) << ran.out;
  EXPECT_NE(slurp(folder_ / "report/index.html").find("<h1>Nothing was tested</h1>"), std::string::npos);
}

TEST_F(ProgramUnderTest, IsReplayedReportedAndRefusedForAnotherOne) {
  EXPECT_EQ(fuzz("quaternion_length", {"--cases", "100", "--report", folder_ / "report"}).code, 1);
  EXPECT_NE(slurp(folder_ / "report/index.html").find("Rotation is not normalised"), std::string::npos);
  const Ran again = contort_program({"replay", corpus(), "--generator", script("quaternion_length")});
  EXPECT_EQ(again.code, 1) << again.out << again.err;
  EXPECT_NE(again.out.find("same="), std::string::npos);
  EXPECT_EQ(again.out.find("cannot run"), std::string::npos) << again.out;
  const Ran built_in = contort_program({"replay", corpus()});
  EXPECT_EQ(built_in.code, 2);
  EXPECT_NE(built_in.err.find("replay.other_generator"), std::string::npos) << built_in.err;
}

TEST_F(ProgramUnderTest, GoesOnFromOneCandidateOfAShrinkToTheNext) {
  EXPECT_EQ(fuzz("lying_speed", {"--cases", "20"}).code, 1);
  std::string found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus() + "/buckets"))
    if (entry.path().filename().string().starts_with("orig-")) found = entry.path().string();
  ASSERT_FALSE(found.empty());
  const std::string starts = folder_ / "starts";
  const std::string counting = "echo >>" + starts + "; exec " + script("lying_speed");
  const Ran ran = contort_program({"shrink", found, "--generator", counting, "-o", folder_ / "small.json", "--json"});
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_GT(Json::parse(ran.out)["evaluations"], 20) << ran.out;
  EXPECT_LE(slurp(starts).size(), 6U) << "a start of the program is a line";
}

TEST_F(ProgramUnderTest, IsComparedWithAnother) {
  const Ran broke = fuzz("nan", {"--against", script("good"), "--cases", "100"});
  EXPECT_EQ(broke.code, 1) << broke.out << broke.err;
  EXPECT_NE(broke.out.find("BROKE  Elbow has NaN or infinite values"), std::string::npos) << broke.out;
  const Ran sides = contort_program({"replay", corpus(), "--generator", script("nan"), "--against", script("good")});
  EXPECT_NE(sides.out.find("against: passes"), std::string::npos) << sides.out << sides.err;
  EXPECT_NE(sides.out.find("first difference at frame"), std::string::npos) << sides.out;
}

// The rows of an audit by action.
std::map<std::string, Json> audited(const std::string& mood, const std::vector<std::string>& more, int code) {
  std::vector<std::string> arguments = {"audit", "--generator", script("moods " + mood), "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ran ran = contort_program(arguments);
  EXPECT_EQ(ran.code, code) << ran.out << ran.err;
  std::map<std::string, Json> rows;
  for (const Json& row : Json::parse(ran.out)) rows[row["action"]] = row;
  return rows;
}

TEST(AuditOfAProgram, CountsEachMotionInWhichItEndsAndGoesOn) {
  const std::map<std::string, Json> rows = audited("crash_above", {"--draws", "40", "--jobs", "2"}, 1);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows.at("swing")["clean"], 40);
  const Json& sulk = rows.at("sulk");
  EXPECT_EQ(sulk["draws"], 40);
  EXPECT_GT(sulk["clean"], 5);
  EXPECT_GT(sulk["findings"]["crash"], 5);
  EXPECT_EQ(sulk["clean"].get<int>() + sulk["findings"]["crash"].get<int>(), 40);
  EXPECT_EQ(sulk["endings"]["crash"].get<std::string>().find(
                "the program ended: exit 1; it printed: moods: nobody sulks at "), 0U) << sulk;
  EXPECT_EQ(audited("crash_above", {"--draws", "40", "--jobs", "1"}, 1), rows);
}

TEST(AuditOfAProgram, StopsARowInWhichItIsTooOftenTooLate) {
  const std::map<std::string, Json> rows =
      audited("hang", {"--draws", "30", "--jobs", "2", "--case-timeout", "0.3"}, 1);
  EXPECT_EQ(rows.at("swing")["clean"], 30);
  EXPECT_EQ(rows.at("sulk")["draws"], 8);
  EXPECT_EQ(rows.at("sulk")["findings"]["timeout"], 8);
}

TEST(AuditOfAProgram, CountsRefusedMotionsByTheirReason) {
  const std::map<std::string, Json> rows = audited("refuse", {"--draws", "20"}, 4);
  const Json& sulk = rows.at("sulk");
  EXPECT_EQ(sulk["refused"], 20);
  EXPECT_EQ(sulk["clean"], 0);
  ASSERT_EQ(sulk["refusals"].size(), 1U) << "numbers make no other reason: " << sulk;
  EXPECT_EQ(sulk["refusals"].begin().value(), 20);
}

TEST_F(ProgramUnderTest, ThatEndsInMostDrawsCannotBeExplainedAndSaysSo) {
  ASSERT_EQ(fuzz("lying_speed", {"--cases", "20"}).code, 1);
  const Ran ran = contort_program({"explain", corpus(), "--generator", script("moods leave"), "--draws", "60"});
  EXPECT_EQ(ran.code, 4) << ran.out << ran.err;
  EXPECT_NE(ran.err.find("explain.program_ended: cause "), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("because the generator makes no motion of 60 of 60 requests like the minimal case: the program "
                         "ended: exit 5"), std::string::npos) << ran.err;
  EXPECT_TRUE(ran.out.find("with_rule=0\n") != std::string::npos) << ran.out;
}

TEST_F(ProgramUnderTest, ThatEndsIsToldByEveryCommandInOneSentence) {
  ASSERT_EQ(fuzz("moods crash", {"--cases", "12"}).code, 1);
  const std::string mood = script("moods crash");
  std::string found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus() + "/buckets"))
    if (entry.path().filename().string().starts_with("min-")) found = entry.path().string();
  ASSERT_FALSE(found.empty());
  const std::string sentence = "the program ended: exit 1; it printed: moods: nobody sulks at ";
  const Ran checked = contort_program({"check", found, "--generator", mood});
  EXPECT_EQ(checked.code, 1);
  EXPECT_EQ(checked.out.find("crash  " + sentence), 0U) << checked.out << checked.err;
  EXPECT_EQ(last_line(checked.out), "RESULT findings=1");
  const Ran json = contort_program({"check", found, "--generator", mood, "--json"});
  EXPECT_EQ(Json::parse(json.out)["findings"][0]["check"], "crash");
  const Ran generated = contort_program({"generate", found, "--generator", mood, "-o", folder_ / "x.json"});
  EXPECT_EQ(generated.code, 1);
  EXPECT_NE(generated.err.find("generator.ended: "), std::string::npos) << generated.err;
  EXPECT_NE(generated.err.find(sentence), std::string::npos) << generated.err;
  EXPECT_EQ(contort_program({"replay", found, "--generator", mood}).code, 1);
  const Ran sides = contort_program({"replay", found, "--generator", mood, "--against", script("moods none")});
  EXPECT_NE(sides.out.find("against: passes"), std::string::npos) << sides.out << sides.err;
}

TEST_F(ProgramUnderTest, IsNoProgramForSpecsOfTheBuiltInOne) {
  const Ran ran = contort_program({"check", CONTORT_SOURCE_DIR "/docs/examples/reach_hand.json", "--generator", script("good")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("allowed are hero"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace contort
