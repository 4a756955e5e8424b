// Cases that break many limits at once: which failures contort fuzz shrinks, and where it lists the others.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "corpus/corpus.h"
#include "tests/cli/program.h"

namespace contort {
namespace {

// Failing cases of the human, two unless a test asks for more.
class CrowdedCases : public ::testing::Test {
 protected:
  Ran fuzz(const std::string& corpus, int shrinks_per_case, int evaluations = 60, int seed = 12,
           int cases = 2) const {
    return contort_program({"fuzz", "--profile", "stress", "--character", "human", "--seed", std::to_string(seed),
                            "--cases", std::to_string(cases), "--shrink-evaluations", std::to_string(evaluations),
                            "--shrinks-per-case", std::to_string(shrinks_per_case), "--corpus", corpus});
  }
  static std::ptrdiff_t new_buckets(const Ran& ran) {
    const std::size_t at = ran.out.find(" new=");
    return at == std::string::npos ? -1 : std::stol(ran.out.substr(at + 5));
  }
  TempFolder folder_;
};

TEST_F(CrowdedCases, TheOptionSaysHowManyOfACaseAreShrunk) {
  const Ran one = fuzz(folder_ / "one", 1), three = fuzz(folder_ / "three", 3);
  EXPECT_LE(new_buckets(one), 2) << one.out;
  EXPECT_GT(new_buckets(three), new_buckets(one)) << three.out;
  EXPECT_LE(new_buckets(three), 6) << three.out;
  EXPECT_NE(one.out.find("of each case only its 1 earliest failures are stored"), std::string::npos) << one.out;
  EXPECT_NE(three.out.find("of each case only its 3 earliest failures are stored"), std::string::npos) << three.out;
}

TEST_F(CrowdedCases, NothingIsSaidOfLateOnesWhereAllAreShrunk) {
  const Ran all = fuzz(folder_ / "all", 1000000, 0, 12, 6);
  EXPECT_GT(new_buckets(all), 10) << all.out;
  EXPECT_EQ(all.out.find("earliest failures are stored"), std::string::npos) << all.out;
}

// Other families are listed in the bucket, and when the case is shrunk again. Seeds are tried until both were seen,
// because the generator decides which failures occur together.
TEST_F(CrowdedCases, WhatComesWithAFailureIsToldWithIt) {
  int with_others = 0, again_with_others = 0;
  for (int seed = 1; seed <= 12 && (with_others == 0 || again_with_others == 0); ++seed) {
    fuzz(folder_ / std::to_string(seed), 1, 60, seed);
    const Result<Corpus> corpus = Corpus::open(folder_ / std::to_string(seed));
    ASSERT_TRUE(corpus);
    std::vector<Issue> damaged;
    for (const Bucket& bucket : corpus->buckets(damaged)) {
      const std::string file = corpus->folder_of(bucket) + "/" + bucket.min;
      const std::vector<Family> others = read_case(file)->co_failures;
      if (others.empty()) continue;
      ++with_others;
      const Ran shown = contort_program({"corpus", "show", corpus->folder(), bucket.id});
      EXPECT_NE(shown.out.find("comes with " + print_family(others.front())), std::string::npos) << shown.out << shown.err;
      const Ran shrunk = contort_program({"shrink", file, "-o", folder_ / "again.json"});
      if (read_case(folder_ / "again.json")->co_failures.empty()) continue;
      ++again_with_others;
      EXPECT_NE(shrunk.out.find("comes with it: "), std::string::npos) << shrunk.out << shrunk.err;
    }
  }
  EXPECT_GT(with_others, 0);
  EXPECT_GT(again_with_others, 0);
}

}  // namespace
}  // namespace contort
