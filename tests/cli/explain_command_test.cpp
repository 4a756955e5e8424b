// contort explain and contort check --known.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corpus/corpus.h"
#include "corpus/evaluator.h"
#include "generator/built_in.h"
#include "tests/cli/program.h"

namespace contort {
namespace {

// A pose out of range: whatever else is drawn, an elbow that is bent the wrong way is reported.
constexpr const char* kBent = R"({"format": "contort.spec/1", "character": {"name": "human"}, "sequences": [{"clips": [{"actions": [
  {"action": "pose", "slot": "arm_left", "duration_frames": 40, "params": {"elbow_deg": 170}}]}]}]})";

class ExplainCommand : public ::testing::Test {
 protected:
  // A corpus with one bucket: the deepest finding of this spec.
  void store(const std::string& text) {
    BuiltInGenerator generator(stock_library());
    Evaluator evaluator(generator);
    Case minimal;
    const Result<Spec> spec = parse_spec(text);
    ASSERT_TRUE(spec) << to_line(spec.issue());
    minimal.spec = *spec;
    const Result<Evaluation> run = evaluator.run(minimal.spec);
    ASSERT_TRUE(run && !run->findings.empty());
    minimal.expect = expectation_of(evaluator.execution(), *run, run->findings.front());
    minimal.cause = cause_without_experiments(minimal.spec);
    ASSERT_TRUE(Corpus::create(folder_ / "c")->add({minimal, minimal, "run"}));
    spill(folder_ / "bent.json", text);
  }
  TempFolder folder_;
};

TEST_F(ExplainCommand, LearnsStoresAndAsks) {
  store(kBent);
  EXPECT_EQ(contort_program({"check", folder_ / "bent.json", "--known", folder_ / "c"}).code, 2) << "no rules yet";
  const Ran told = contort_program({"explain", folder_ / "c", "--draws", "100", "--header", folder_ / "rules.h"});
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.out.find("pose.elbow_deg > "), std::string::npos) << told.out;
  EXPECT_TRUE(told.out.ends_with("RESULT causes=1 with_rule=1\n")) << told.out;
  EXPECT_NE(slurp(folder_ / "rules.h").find("pose.elbow_deg"), std::string::npos);

  const std::string stored = slurp(folder_ / "c/rules.json");
  EXPECT_EQ(contort_program({"explain", folder_ / "c", "--draws", "90"}).out, told.out) << "nothing is learned anew";
  EXPECT_EQ(contort_program({"explain", folder_ / "c", "--stored"}).out, told.out);
  EXPECT_EQ(slurp(folder_ / "c/rules.json"), stored);
  EXPECT_EQ(contort_program({"explain", folder_ / "c", "--draws", "100", "--again", "--jobs", "3"}).out, told.out);
  EXPECT_EQ(slurp(folder_ / "c/rules.json"), stored);
  EXPECT_EQ(contort_program({"explain", folder_ / "c", "--json"}).out, stored);
}

TEST_F(ExplainCommand, TheReportTellsTheRuleAndWhatIsFixedIsForgotten) {
  store(kBent);
  ASSERT_EQ(contort_program({"explain", folder_ / "c", "--draws", "100"}).code, 0);
  contort_program({"--gl", "none", "report", folder_ / "c", "-o", folder_ / "report"});
  EXPECT_NE(slurp(folder_ / "report/index.html").find("fresh cases where pose.elbow_deg &gt; "), std::string::npos);
  const nlohmann::json report = nlohmann::json::parse(slurp(folder_ / "report/report.json"));
  EXPECT_FALSE(report["causes"][0]["conditions"]["human"].get<std::string>().empty());

  std::filesystem::remove_all(folder_ / "c/buckets");
  std::filesystem::create_directory(folder_ / "c/buckets");
  EXPECT_TRUE(contort_program({"explain", folder_ / "c"}).out.ends_with("RESULT causes=0 with_rule=0\n"));
  EXPECT_EQ(slurp(folder_ / "c/rules.json").find("elbow"), std::string::npos);
}

TEST_F(ExplainCommand, ACheckAgainstRulesMakesNoMotionAndSaysWhatIsKnown) {
  store(kBent);
  ASSERT_EQ(contort_program({"explain", folder_ / "c", "--draws", "100"}).code, 0);
  const Ran known = contort_program({"check", folder_ / "bent.json", "--known", folder_ / "c"});
  EXPECT_EQ(known.code, 1);
  EXPECT_TRUE(known.out.starts_with("KNOWN ")) << known.out;
  EXPECT_TRUE(known.out.ends_with("RESULT known=1 rules=1\n")) << known.out;
  std::string straight = kBent;
  straight.replace(straight.find("170"), 3, "20");
  spill(folder_ / "straight.json", straight);
  const Ran fine = contort_program({"check", folder_ / "straight.json", "--known", folder_ / "c", "--json"});
  EXPECT_EQ(fine.code, 0);
  EXPECT_TRUE(nlohmann::json::parse(fine.out)["known"].empty());
}

TEST_F(ExplainCommand, TakesEveryIdThatCausesPrints) {
  store(kBent);
  const nlohmann::json causes = nlohmann::json::parse(contort_program({"causes", folder_ / "c", "--json"}).out);
  const nlohmann::json& cause = causes.at("causes").at(0);
  for (const nlohmann::json& of : {cause, cause.at("buckets").at(0)}) {
    const std::string id = of.at("id").get<std::string>();
    const Ran told = contort_program({"explain", folder_ / "c", "--stored", "--cause", id});
    EXPECT_EQ(told.code, 0) << told.err;
    EXPECT_TRUE(told.out.ends_with("RESULT causes=1 with_rule=0\n")) << told.out;
    EXPECT_EQ(contort_program({"corpus", "note", folder_ / "c", "--cause", id, "--text", "seen"}).code, 0);
  }
}

TEST_F(ExplainCommand, RefusesWhatItCannotUse) {
  EXPECT_EQ(contort_program({"explain", folder_ / "nowhere"}).code, 2);
  store(kBent);
  EXPECT_EQ(contort_program({"explain", folder_ / "c", "--cause", "zz"}).code, 2);
  EXPECT_EQ(contort_program({"explain", folder_ / "c", "--stored", "--again"}).code, 2);
  EXPECT_EQ(contort_program({"explain", folder_ / "c", "--draws", "3"}).code, 2);
  EXPECT_EQ(contort_program({"explain", folder_ / "c", "--header", folder_ / "nowhere/rules.h"}).code, 3);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "c/rules.json")) << "refused before anything is learned";
  spill(folder_ / "c/rules.json", "[]");
  EXPECT_EQ(contort_program({"explain", folder_ / "c"}).code, 2);
  EXPECT_EQ(contort_program({"check", folder_ / "bent.json", "--known", folder_ / "c"}).code, 2);
}

}  // namespace
}  // namespace contort
