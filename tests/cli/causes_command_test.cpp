// Causes on the terminal: after a run, and of a corpus.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/corpus.h"
#include "tests/cli/program.h"

namespace contort {
namespace {

class CausesCommand : public ::testing::Test {
 protected:
  Ran fuzz(const std::string& corpus, int seed) const {
    return contort_program({"fuzz", "--profile", "stress", "--character", "human", "--seed", std::to_string(seed), "--cases",
                            "1", "--shrink-evaluations", "8", "--shrinks-per-case", "3", "--corpus", corpus});
  }
  TempFolder folder_;
};

TEST_F(CausesCommand, ARunEndsWithAVerdictAndItsCausesWithinFortyLines) {
  const Ran ran = fuzz(folder_ / "c", 12);
  EXPECT_LE(std::ranges::count(ran.out, '\n'), 40) << ran.out;
  EXPECT_TRUE(ran.out.starts_with("0.0 % of 1 case is clean; 1 fails, by ")) << ran.out;
  EXPECT_NE(ran.out.find("\n1.  NEW   "), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("  contort replay /"), std::string::npos) << "commands have absolute paths: " << ran.out;
  const Ran again = fuzz(folder_ / "c", 12);
  EXPECT_NE(again.out.find(", 0 of them new.\n"), std::string::npos) << again.out;
  EXPECT_EQ(again.out.find("NEW"), std::string::npos) << again.out;
}

// A shard leaves it to the merge to file its failures.
TEST_F(CausesCommand, AreNotClaimedOfFailuresWithoutABucket) {
  const Ran ran = contort_program({"fuzz", "--profile", "stress", "--character", "human", "--seed", "12", "--cases", "2",
                                   "--shrink-evaluations", "1", "--shrinks-per-case", "1", "--shard", "0/2", "--corpus",
                                   folder_ / "shard"});
  EXPECT_TRUE(ran.out.starts_with("0.0 % of 2 cases are clean; 2 fail; none has a bucket yet, so no cause is known.\n"))
      << ran.out << ran.err;
}

TEST_F(CausesCommand, OfACorpusHoldEveryBucketOnceAndAreComparedWithABaseline) {
  fuzz(folder_ / "a", 12);
  const Ran told = contort_program({"causes", folder_ / "a", "--json"});
  const nlohmann::json all = nlohmann::json::parse(told.out);
  const nlohmann::json buckets = nlohmann::json::parse(contort_program({"corpus", "list", folder_ / "a", "--json"}).out);
  std::vector<std::string> listed, of_causes;
  for (const auto& bucket : buckets) {
    listed.push_back(bucket["id"]);
    const std::string minimal = bucket["folder"].get<std::string>() + "/" + bucket["min"].get<std::string>();
    EXPECT_EQ(read_case(minimal)->cause.scheme, kCauseScheme) << "the run stores the cause: " << minimal;
  }
  for (const auto& cause : all["causes"]) {
    EXPECT_FALSE(cause["is_new"].get<bool>());
    for (const auto& bucket : cause["buckets"]) of_causes.push_back(bucket["id"]);
  }
  std::ranges::sort(listed);
  std::ranges::sort(of_causes);
  EXPECT_EQ(listed, of_causes);
  EXPECT_LE(all["causes"].size(), listed.size());
  contort_program({"fuzz", "--cases", "0", "--corpus", folder_ / "empty"});
  const Ran fresh = contort_program({"causes", folder_ / "a", "--baseline", folder_ / "empty", "--json"});
  for (const auto& cause : nlohmann::json::parse(fresh.out)["causes"]) EXPECT_TRUE(cause["is_new"].get<bool>());
  EXPECT_EQ(contort_program({"causes", folder_ / "nowhere"}).code, 2);
}

}  // namespace
}  // namespace contort
