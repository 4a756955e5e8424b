// contort report: the folder that people open.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/ending_case.h"
#include "process/isolate.h"
#include "tests/cli/program.h"
#include "tests/cli/small_library.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

class ReportOfCorpus : public testing::Test {
 protected:
  ReportOfCorpus() : corpus_(create(folder_)) {
    add(failing_case(bent_elbow(158), "joint_range", kElbow), failing_case(bent_elbow(165), "joint_range", kElbow));
  }
  void add(const Case& minimal, const Case& original) {
    EXPECT_TRUE(corpus_.add({.minimal = minimal, .original = original, .run = "seed_1"}));
  }
  // The exit code, with the output.
  Ran report(std::vector<std::string> options = {}, const std::string& gl = "none") {
    std::vector<std::string> call = {"--gl", gl, "report", corpus_.folder(), "-o", folder_ / "out"};
    call.insert(call.end(), options.begin(), options.end());
    return contort_program(call);
  }
  std::vector<std::string> files(const std::string& below) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / ("out/" + below)))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }
  std::string key() const {
    std::vector<Issue> damaged;
    return folder_name(corpus_.buckets(damaged).front());
  }

  TempFolder folder_;
  Corpus corpus_;
};

TEST_F(ReportOfCorpus, HasWhatTheViewerShowsOfEachBucket) {
  const Ran ran = report();
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(files("cases"), std::vector<std::string>{key() + ".js"});
  const std::string script = slurp(folder_ / ("out/cases/" + key() + ".js"));
  EXPECT_TRUE(script.starts_with("// made of ")) << "what it was made of, see DIR/cases in docs/reference/report.md";
  EXPECT_NE(script.find("\ncontortCase(\"" + key() + "\", {"), std::string::npos);
  EXPECT_NE(script.find("\"role\":\"minimal\""), std::string::npos);
  EXPECT_NE(script.find("\"role\":\"original\""), std::string::npos);
  const std::string page = slurp(folder_ / "out/index.html");
  EXPECT_NE(page.find("data-case='" + key() + "'"), std::string::npos);
  EXPECT_NE(page.find("data-phase='" + failing_case(bent_elbow(158), "joint_range", kElbow).expect.phase + "'"),
            std::string::npos);
}

TEST_F(ReportOfCorpus, HasEachBucketInOneCause) {
  const Case deeper = failing_case(bent_elbow(170), "joint_range", kElbow);
  add(deeper, deeper);
  ASSERT_EQ(report({}).code, 0);
  const nlohmann::json told = nlohmann::json::parse(slurp(folder_ / "out/report.json"));
  std::vector<std::string> of_causes, of_corpus;
  for (const auto& cause : told["causes"]) {
    EXPECT_NE(cause["headline"], "");
    for (const auto& bucket : cause["buckets"]) of_causes.push_back(bucket);
  }
  std::vector<Issue> damaged;
  for (const Bucket& bucket : corpus_.buckets(damaged)) of_corpus.push_back(bucket.id);
  std::ranges::sort(of_causes);
  std::ranges::sort(of_corpus);
  EXPECT_EQ(of_causes, of_corpus);
  EXPECT_FALSE(of_causes.empty());
  const std::string page = slurp(folder_ / "out/index.html");
  EXPECT_NE(page.find("<section id='causes'>"), std::string::npos);
  EXPECT_NE(page.find("<a href='#case=" + key() + "'>"), std::string::npos) << "it opens the deepest case";
}

TEST_F(ReportOfCorpus, TellsTheMeasuredValueAndItsLimit) {
  ASSERT_EQ(report({}).code, 0);
  EXPECT_NE(slurp(folder_ / "out/index.html").find("at worst is at 158\u00B0, limit 150\u00B0"), std::string::npos);
  EXPECT_NE(slurp(folder_ / ("out/cases/" + key() + ".js")).find("\"measured\":\"is at 158\u00B0, limit 150\u00B0\""),
            std::string::npos);
  std::ofstream(folder_ / "soft.json") << R"({"format": "contort.settings/1", "limits": [{"check": "joint_range",
        "subject": "*", "phase": "mid_clip", "tolerance": 0.01, "reason": "soft"}]})";
  const Ran softer = contort_program(
      {"--gl", "none", "--settings", folder_ / "soft.json", "report", corpus_.folder(), "-o", folder_ / "out"});
  ASSERT_EQ(softer.code, 0) << softer.err;
  EXPECT_EQ(slurp(folder_ / "out/index.html").find("limit 150"), std::string::npos) << "the limit is not known";
}

TEST_F(ReportOfCorpus, TellsNewCausesFromThoseOfTheBaseline) {
  const auto causes = [&] { return nlohmann::json::parse(slurp(folder_ / "out/report.json"))["causes"]; };
  ASSERT_EQ(report({}).code, 0);
  EXPECT_EQ(causes()[0]["news"], "new");
  ASSERT_EQ(report({"--baseline", corpus_.folder()}).code, 0);
  EXPECT_EQ(causes()[0]["news"], "known");
  EXPECT_NE(slurp(folder_ / "out/index.html").find("<span class='chip'>known</span>"), std::string::npos);
}

// Playing such a case would end the program.
TEST_F(ReportOfCorpus, HasNoMotionOfACaseThatEndsTheGenerator) {
  const Case crash = ending_case(bent_elbow(20), {Ending::Kind::crash, "SIGSEGV", ""});
  add(crash, crash);
  const Ran ran = report({}, "auto");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(files("cases").size(), 1U);
  EXPECT_EQ(files("strips").size(), 3U) << "one still, one moving, and from where they are seen";
  EXPECT_NE(slurp(folder_ / "out/index.html").find("no motion to show"), std::string::npos);
}

TEST_F(ReportOfCorpus, DrawsEachPictureOnceAndKeepsNoOldOnes) {
  ASSERT_EQ(report({}, "auto").code, 0);
  const std::vector<std::string> pictures = files("strips");
  ASSERT_EQ(pictures.size(), 3U);
  const auto drawn = fs::last_write_time(folder_ / ("out/strips/" + pictures[0]));
  add(failing_case(bent_elbow(152), "joint_range", kElbow), failing_case(bent_elbow(152), "joint_range", kElbow));
  ASSERT_EQ(report({}, "auto").code, 0);
  EXPECT_EQ(files("strips").size(), 3U) << "the bucket has another minimal case, and so other pictures";
  EXPECT_NE(files("strips"), pictures);
  const auto again = fs::last_write_time(folder_ / ("out/strips/" + files("strips")[0]));
  EXPECT_GT(again, drawn);
  ASSERT_EQ(report({}, "auto").code, 0);
  EXPECT_EQ(fs::last_write_time(folder_ / ("out/strips/" + files("strips")[0])), again);
}

// 0.1 s for each case, if nothing has changed since the last report.
TEST_F(ReportOfCorpus, MakesEachCaseOnceOfTheSame) {
  ASSERT_EQ(report().code, 0);
  const std::string path = folder_ / ("out/cases/" + key() + ".js");
  const std::string made = slurp(path);
  const auto plant = [&] { spill(path, made.substr(0, made.find('\n')) + "\nplanted"); };
  const auto is_planted = [&] { return slurp(path).ends_with("planted"); };
  const auto report_with = [&](const std::string& option, const std::string& value) {
    const Ran ran = contort_program({"--gl", "none", option, value, "report", corpus_.folder(), "-o", folder_ / "out"});
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  plant();
  ASSERT_EQ(report().code, 0);
  EXPECT_TRUE(is_planted()) << "nothing changed, so it was left as it is";
  spill(folder_ / "limits.json", R"({"format":"contort.settings/1","limits":[
    {"check":"joint_range","tolerance":0.01,"reason":"a test"}]})");
  report_with("--settings", folder_ / "limits.json");
  EXPECT_FALSE(is_planted()) << "margins are others by other limits";
  ASSERT_EQ(report().code, 0);
  EXPECT_EQ(slurp(path), made);
  plant();
  small::write_library(folder_ / "library");
  report_with("--library", folder_ / "library");
  EXPECT_FALSE(is_planted()) << "what the library has may be in the motion";
  spill(path, made.substr(made.find('\n') + 1));
  ASSERT_EQ(report().code, 0);
  EXPECT_EQ(slurp(path), made) << "a file that does not say what it was made of is made again";
  plant();
  add(failing_case(bent_elbow(152), "joint_range", kElbow), failing_case(bent_elbow(152), "joint_range", kElbow));
  ASSERT_EQ(report().code, 0);
  EXPECT_FALSE(is_planted()) << "the bucket has another minimal case";
}

// A folder of a project may have cases and strips of its own.
TEST_F(ReportOfCorpus, LeavesOtherPeoplesFilesAlone) {
  const std::string kOld = "joint_range-0123456789ab";
  for (const char* below : {"cases", "strips"}) fs::create_directories(folder_ / ("out/" + std::string(below)));
  const std::string theirs[] = {"cases/login.js", "cases/a-b.js", "strips/art.png", "strips/joint_range-0123.webp"};
  const std::string ours[] = {"cases/" + kOld + ".js", "strips/" + kOld + "-01234567.png"};
  for (const std::string& name : theirs) std::ofstream(folder_ / ("out/" + name)) << name;
  for (const std::string& name : ours) std::ofstream(folder_ / ("out/" + name)) << name;
  EXPECT_EQ(report({}, "auto").code, 2) << "nothing says that this folder holds a report";
  for (const std::string& name : ours) EXPECT_TRUE(fs::exists(folder_ / ("out/" + name))) << name;
  std::ofstream(folder_ / "out/report.json") << R"({"format":"contort.report/1"})";
  ASSERT_EQ(report({}, "auto").code, 0);
  for (const std::string& name : theirs) EXPECT_TRUE(fs::exists(folder_ / ("out/" + name))) << name;
  for (const std::string& name : ours) EXPECT_FALSE(fs::exists(folder_ / ("out/" + name))) << name;
}

TEST_F(ReportOfCorpus, ACheckThatThisBuildDoesNotHaveIsShownAllTheSame) {
  Case other = failing_case(bent_elbow(158), "joint_range", kElbow);
  other.expect.check = "of_tomorrow";
  add(other, other);
  const Ran ran = report();
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(files("cases").size(), 2U);
}

TEST_F(ReportOfCorpus, WhatCannotBeShownSaysWhy) {
  Case other = failing_case(bent_elbow(158), "joint_range", kElbow);
  other.spec.character.name = "of_tomorrow";
  add(other, other);
  const Ran ran = report();
  EXPECT_EQ(ran.code, 0) << ran.err;
  ASSERT_EQ(files("cases").size(), 2U);
  int problems = 0;
  for (const std::string& name : files("cases"))
    problems += slurp(folder_ / ("out/cases/" + name)).find("\"problem\"") != std::string::npos;
  EXPECT_EQ(problems, 1);
  EXPECT_NE(ran.err.find("the report cannot show"), std::string::npos);
}

TEST_F(ReportOfCorpus, PicturesAreOfTheLimitsThatAreGiven) {
  ASSERT_EQ(report({}, "auto").code, 0);
  const std::vector<std::string> pictures = files("strips");
  const std::string before = slurp(folder_ / ("out/strips/" + pictures[0]));
  ASSERT_EQ(report().code, 0);
  EXPECT_EQ(files("strips"), pictures) << "--gl none draws nothing and removes nothing";
  std::ofstream(folder_ / "limits.json") << R"({"format":"contort.settings/1","limits":[
    {"check":"joint_range","tolerance":0.5,"reason":"a test"}]})";
  const Ran ran =
      contort_program({"--settings", folder_ / "limits.json", "report", corpus_.folder(), "-o", folder_ / "out"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  ASSERT_EQ(files("strips").size(), 3U);
  EXPECT_NE(files("strips"), pictures);
  EXPECT_NE(slurp(folder_ / ("out/strips/" + files("strips")[0])), before) << "nothing is violated by these limits";
  std::ofstream(folder_ / "limits.json") << "{";
  const Ran bad =
      contort_program({"--settings", folder_ / "limits.json", "report", corpus_.folder(), "-o", folder_ / "o"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_EQ(lines_of(bad.err).size(), 1U) << bad.err;
  EXPECT_FALSE(fs::exists(folder_ / "o"));
}

TEST_F(ReportOfCorpus, IsOneFileForMail) {
  EXPECT_EQ(report({"--single-file", folder_ / "mail.html"}, "auto").code, 0);
  const std::string page = slurp(folder_ / "mail.html");
  EXPECT_NE(page.find("id='case-" + key() + "'"), std::string::npos);
  EXPECT_NE(page.find("src='data:image/png;base64,iVBOR"), std::string::npos);
  for (const char* outside : {"src='strips", "href='strips", "href='report.json'"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  const Ran alone = contort_program({"report", corpus_.folder(), "--single-file", folder_ / "x.html"});
  EXPECT_EQ(alone.code, 2);
  EXPECT_EQ(lines_of(alone.err).size(), 1U) << alone.err;
}

TEST_F(ReportOfCorpus, WithoutAnyoneWhoDrawsIsCompleteButForPictures) {
  const Ran ran = report();
  EXPECT_EQ(ran.code, 0);
  EXPECT_NE(ran.err.find("no pictures"), std::string::npos);
  EXPECT_TRUE(files("strips").empty());
  const Ran refused = report({}, "vulkan");
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(lines_of(refused.err).size(), 1U);
}

}  // namespace

}  // namespace contort
