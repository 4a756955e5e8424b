// The output of fuzz, replay and report for people: sentences, without words of file formats, and not too many lines.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/program.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

bool line_says(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

// All but the line for programs and the commands, which name files.
std::vector<std::string> lines_for_people(const std::string& text) {
  std::vector<std::string> lines = lines_of(text);
  std::erase_if(lines, [](const std::string& line) { return line.starts_with("RESULT "); });
  for (std::string& line : lines) line = line.substr(0, line.find("contort replay "));
  return lines;
}

void expect_plain(const Ran& ran) {
  for (const std::string& line : lines_for_people(ran.out))
    for (const char* word : {"|", "GATES", "gating", "bucket", "famil", "same"})
      EXPECT_FALSE(line_says(line, word)) << word << " in: " << line;
}

class PlainWords : public testing::Test {
 protected:
  std::string file(const std::string& name, const Case& stored) {
    spill(folder_ / name, print_case(stored));
    return folder_ / name;
  }
  TempFolder folder_;
};

TEST_F(PlainWords, ACaseThatStillFailsSaysWhatFailsOnWhomAndByHowMuch) {
  const Ran ran = contort_program({"replay", file("elbow.json", elbow_case())});
  const std::string line = lines_of(ran.out).front();
  EXPECT_TRUE(line.starts_with("still fails ")) << line;
  EXPECT_TRUE(line_says(line, "Left elbow leaves its range during pose (human): is at ")) << line;
  EXPECT_TRUE(line_says(line, "\xC2\xB0, limit ") && line_says(line, "\xC2\xB0, at frame ")) << line;
  EXPECT_EQ(lines_of(ran.out).size(), 2U) << "the line of a single case says all: " << ran.out;
  expect_plain(ran);
}

TEST_F(PlainWords, SeveralCasesEndWithASentence) {
  Case passes = elbow_case(), other = elbow_case(), refused = elbow_case();
  passes.spec = bent_elbow(100);
  other.expect.subject = "arm_right/elbow max";
  refused.spec.character.name = "nobody";
  const Ran ran = contort_program({"replay", file("fails.json", elbow_case()), file("passes.json", passes),
                                   file("other.json", other), file("refused.json", refused)});
  const std::vector<std::string> lines = lines_of(ran.out);
  ASSERT_EQ(lines.size(), 6U) << ran.out;
  EXPECT_TRUE(lines[1].starts_with("passes now ")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("fails differently ") && line_says(lines[2], "Right elbow leaves its range"));
  EXPECT_TRUE(line_says(lines[2], "; now: Left elbow ")) << lines[2];
  EXPECT_TRUE(lines[3].starts_with("cannot run ") && line_says(lines[3], "nobody")) << lines[3];
  EXPECT_EQ(lines[4], "4 cases: 1 still fails, 1 fails differently, 1 passes now, 1 cannot run.");
  expect_plain(ran);
}

TEST_F(PlainWords, AFailureOfACorpusHasItsHeadlineAndSaysThatItFailsTheBuild) {
  const Corpus corpus = create(folder_);
  const Case stored = elbow_case();
  ASSERT_TRUE(corpus.add({stored, stored, "seed_1"}));
  const Ran ran = contort_program({"replay", corpus.folder()});
  const std::vector<std::string> lines = lines_of(ran.out);
  ASSERT_EQ(lines.size(), 3U) << ran.out;
  EXPECT_TRUE(lines[0].starts_with("still fails ")) << lines[0];
  const std::string told = "  new, fails the build  Left elbow leaves its range during pose (human)  contort replay ";
  EXPECT_TRUE(line_says(lines[0], told)) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("1 stored failure in ") && lines[1].ends_with(": 1 still fails; 1 fails the build."));
  expect_plain(ran);
}

TEST_F(PlainWords, AReportCountsTheFailuresAndCausesThatTheListOfCausesCounts) {
  const std::string corpus = folder_ / "corpus", report = folder_ / "report";
  const Ran ran = contort_program({"fuzz", "--profile", "stress", "--character", "human", "--seed", "12", "--cases", "6",
                                   "--shrink-evaluations", "0", "--shrinks-per-case", "1000000", "--corpus", corpus,
                                   "--report", report, "--gl", "none"});
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_LE(lines_of(ran.out).size(), 40U) << ran.out;
  expect_plain(ran);
  const std::string causes = last_line(contort_program({"causes", corpus}).out);  // "9 causes, 31 failures"
  const std::string of_causes = causes.substr(0, causes.find(", ")), failures = causes.substr(causes.find(", ") + 2);
  EXPECT_TRUE(line_says(ran.out, "report: " + report + "/index.html (" + failures + " of " + of_causes + ")")) << ran.out;
  EXPECT_TRUE(line_says(last_line(contort_program({"corpus", "list", corpus}).out), failures + " of " + of_causes + ", "));
}

}  // namespace

}  // namespace contort
