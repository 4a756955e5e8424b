// Causes on the terminal: after a run, and of a corpus.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/corpus.h"
#include "tests/cli/program.h"

namespace contort {
namespace {

class CausesCommand : public ::testing::Test {
 protected:
  Ran fuzz(const std::string& corpus, int seed, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"fuzz", "--profile", "stress", "--character", "human", "--cases", "1",
                                    "--shrink-evaluations", "8", "--shrinks-per-case", "3", "--corpus", corpus,
                                    "--seed", std::to_string(seed)};
    all.insert(all.end(), more.begin(), more.end());
    return contort_program(all);
  }
  nlohmann::json json_of(std::vector<std::string> arguments) const {
    arguments.push_back("--json");
    return nlohmann::json::parse(contort_program(arguments).out);
  }
  TempFolder folder_;
};

TEST_F(CausesCommand, ARunEndsWithAVerdictAndItsCausesWithinFortyLines) {
  const Ran ran = fuzz(folder_ / "c", 12);
  EXPECT_LE(std::ranges::count(ran.out, '\n'), 40) << ran.out;
  EXPECT_TRUE(ran.out.starts_with("0.0 % of 1 case is clean; 1 case fails, by ")) << ran.out;
  EXPECT_NE(ran.out.find("\n1.  NEW   "), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("  contort replay /"), std::string::npos) << "commands have absolute paths: " << ran.out;
  const Ran again = fuzz(folder_ / "c", 12);
  EXPECT_NE(again.out.find(", 0 of them new.\n"), std::string::npos) << again.out;
  EXPECT_EQ(again.out.find("NEW"), std::string::npos) << again.out;
}

TEST_F(CausesCommand, AreNotNewIfTheBaselineHasThem) {
  fuzz(folder_ / "first", 12);
  const Ran list = contort_program({"corpus", "list", folder_ / "first", "--json"});
  spill(folder_ / "list.json", list.out);
  for (const std::string& baseline : {folder_ / "first", folder_ / "list.json"}) {
    const Ran second = fuzz(folder_ / "second", 12, {"--baseline", baseline});
    EXPECT_NE(second.out.find(", 0 of them new.\n"), std::string::npos) << second.out << second.err;
    std::filesystem::remove_all(folder_ / "second");
  }
}

// One case is weak evidence against a baseline that never saw its failures: they are listed, and do not fail the build.
TEST_F(CausesCommand, AreRareIfOneCaseShowsThemAndTheBaselineNeverDid) {
  const std::string calm = folder_ / "calm";
  ASSERT_EQ(contort_program({"fuzz", "--profile", "tame", "--cases", "64", "--seed", "3", "--corpus", calm}).code, 0);
  ASSERT_EQ(fuzz(folder_ / "alone", 12).code, 1);
  const Ran compared = fuzz(folder_ / "compared", 12, {"--baseline", calm});
  EXPECT_EQ(compared.code, 0) << compared.out;
  EXPECT_NE(compared.out.find(", 0 of them new, "), std::string::npos) << compared.out;
  EXPECT_NE(compared.out.find("\n1.  RARE  "), std::string::npos) << compared.out;
}

TEST_F(CausesCommand, FailARunFromTheSeverityOnThatIsAskedFor) {
  EXPECT_EQ(fuzz(folder_ / "c", 12).code, 1);
  const double severity = json_of({"causes", folder_ / "c"})["causes"][0]["severity"];
  ASSERT_GT(severity, 0.0);
  const auto code_for = [&](double least) {
    std::filesystem::remove_all(folder_ / "c");
    return fuzz(folder_ / "c", 12, {"--fail-on", std::to_string(least)}).code;
  };
  EXPECT_EQ(code_for(0.99 * severity), 1);
  EXPECT_EQ(code_for(1.01 * severity), 0);
  EXPECT_EQ(code_for(101.0), 2);
  EXPECT_EQ(fuzz(folder_ / "c", 12, {"--fail-on", "nan"}).code, 2);
  const Ran compared = fuzz(folder_ / "c", 12, {"--fail-on", "1", "--against", "contort"});
  EXPECT_NE(compared.err.find("excludes"), std::string::npos) << "a comparison has its own gate: " << compared.err;
  fuzz(folder_ / "other", 12);
  EXPECT_EQ(fuzz(folder_ / "third", 12, {"--fail-on", "0.001", "--baseline", folder_ / "other"}).code, 0);
}

// A shard leaves it to the merge to file its failures.
TEST_F(CausesCommand, AreNotClaimedOfFailuresWithoutABucket) {
  const Ran ran = contort_program({"fuzz", "--profile", "stress", "--character", "human", "--seed", "12", "--cases", "2",
                                   "--shrink-evaluations", "1", "--shrinks-per-case", "1", "--shard", "0/2", "--corpus",
                                   folder_ / "shard"});
  EXPECT_TRUE(ran.out.starts_with("0.0 % of 2 cases are clean; 2 cases fail; none has a smallest case yet, so no cause is known.\n"))
      << ran.out << ran.err;
}

TEST_F(CausesCommand, OfACorpusHoldEveryBucketOnceAndAreComparedWithABaseline) {
  fuzz(folder_ / "a", 12);
  const Ran told = contort_program({"causes", folder_ / "a", "--json"});
  const nlohmann::json all = nlohmann::json::parse(told.out);
  const nlohmann::json buckets = json_of({"corpus", "list", folder_ / "a"});
  std::vector<std::string> listed, of_causes;
  for (const auto& bucket : buckets) {
    listed.push_back(bucket["id"]);
    const std::string minimal = bucket["folder"].get<std::string>() + "/" + bucket["min"].get<std::string>();
    EXPECT_EQ(read_case(minimal)->cause.scheme, kCauseScheme) << "the run stores the cause: " << minimal;
  }
  for (const auto& cause : all["causes"]) {
    EXPECT_EQ(cause["news"], "known");
    for (const auto& bucket : cause["buckets"]) of_causes.push_back(bucket["id"]);
  }
  std::ranges::sort(listed);
  std::ranges::sort(of_causes);
  EXPECT_EQ(listed, of_causes);
  EXPECT_LE(all["causes"].size(), listed.size());
  contort_program({"fuzz", "--cases", "0", "--corpus", folder_ / "empty"});
  const nlohmann::json fresh = json_of({"causes", folder_ / "a", "--baseline", folder_ / "empty"});
  for (const auto& cause : fresh["causes"]) EXPECT_EQ(cause["news"], "new");
  EXPECT_EQ(contort_program({"causes", folder_ / "nowhere"}).code, 2);
}

TEST_F(CausesCommand, AreTriagedAsOne) {
  fuzz(folder_ / "c", 12);
  const nlohmann::json causes = json_of({"causes", folder_ / "c"})["causes"];
  const std::string id = causes[0]["id"];
  std::set<std::string> of_cause;
  for (const auto& bucket : causes[0]["buckets"]) of_cause.insert(bucket["id"]);
  const auto ack = [&](std::vector<std::string> what) {
    std::vector<std::string> all = {"corpus", "ack", folder_ / "c", "--owner", "ana", "--ticket", "12"};
    all.insert(all.end(), what.begin(), what.end());
    return contort_program(all);
  };
  const Ran refused = ack({"--cause", id, "--cause", "ffffffffffffff"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("corpus.no_cause"), std::string::npos) << refused.err;
  EXPECT_NE(ack({}).err.find("corpus.nothing_named"), std::string::npos);
  const auto states = [&] {
    std::map<std::string, std::string> state_of;
    for (const auto& bucket : json_of({"corpus", "list", folder_ / "c"})) state_of[bucket["id"]] = bucket["state"];
    return state_of;
  };
  for (const auto& [bucket, state] : states()) EXPECT_EQ(state, "new") << "what is refused changes nothing: " << bucket;
  EXPECT_EQ(ack({"--cause", id.substr(0, 11)}).code, 0);
  for (const auto& [bucket, state] : states()) EXPECT_EQ(state, of_cause.contains(bucket) ? "open" : "new") << bucket;
}

}  // namespace
}  // namespace contort
