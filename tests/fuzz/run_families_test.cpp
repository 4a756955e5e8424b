// A run chooses the failures of a case that it shrinks, and lists others with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "tests/checks/family_text.h"
#include "tests/fuzz/small_runs.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

namespace fs = std::filesystem;
using namespace small_runs;

class RunFamilies : public testing::Test {
 protected:
  TempFolder folder_;
};

// Returns the cases in which each family is shrunk, by the rule alone: families of a case, the earliest first.
std::map<Family, std::vector<std::int64_t>> shrunk_by_the_rule(const std::vector<FailingCase>& failing,
                                                               const RunConfig& config) {
  std::map<Family, std::vector<std::int64_t>> shrunk;
  for (const FailingCase& one : failing)
    for (std::size_t rank = 0; rank < one.families.size(); ++rank) {
      std::vector<std::int64_t>& indices = shrunk[one.families[rank]];
      if (std::cmp_less(rank, config.shrinks_per_case) && std::ssize(indices) < config.shrinks_per_family)
        indices.push_back(one.index);
    }
  return shrunk;
}

// The first frame and the negated depth of each family, which decide their order.
std::map<Family, std::pair<int, double>> begins_of(const Spec& spec) {
  std::map<Family, std::pair<int, double>> begins;
  for (const Finding& f : StageEvaluator().run(*build_stage(spec, library())).findings) {
    const Family family{f.check, spec.character.name, f.subject};
    const std::pair begin(f.first_frame, -f.depth);
    const auto [known, is_new] = begins.try_emplace(family, begin);
    if (!is_new) known->second = std::min(known->second, begin);
  }
  return begins;
}

TEST_F(RunFamilies, ComeByTheirFirstFramesAndThoseThatBeginTogetherTheDeepestFirst) {
  RunConfig config = config_of(20, 1);
  config.draw.characters = {"human"};
  config.shrink.max_evaluations = 0;
  int together = 0;
  run_fuzz(
      config, generator(), create(folder_ / "corpus"), [](const RunProgress&) {}, [] { return false; },
      [&](const FailingCase& one) {
        const auto begins = begins_of(one.spec);
        ASSERT_EQ(one.families.size(), begins.size());
        for (std::size_t i = 1; i < one.families.size(); ++i) {
          const auto &before = begins.at(one.families[i - 1]), &after = begins.at(one.families[i]);
          EXPECT_LE(before, after) << one.families[i - 1] << ", " << one.families[i];
          together += before.first == after.first;
        }
      });
  EXPECT_GT(together, 0);
}

TEST_F(RunFamilies, TheEarliestOfACaseAreShrunkAndTheOthersCounted) {
  for (const int most : {1, 2, 1000}) {
    RunConfig config = config_of(16, 2);
    config.draw.characters = {"human"};
    config.shrinks_per_case = most, config.shrinks_per_family = 3, config.shrink.max_evaluations = 0;
    std::vector<FailingCase> failing;
    const RunResult result = run_fuzz(
        config, generator(), create(folder_ / std::to_string(most)), [](const RunProgress&) {}, [] { return false; },
        [&](const FailingCase& one) { failing.push_back(one); });
    std::map<Family, std::vector<std::int64_t>> shrunk;
    for (const auto& [family, count] : result.record.families) shrunk[family] = count.first_indices;
    EXPECT_EQ(shrunk, shrunk_by_the_rule(failing, config)) << most;
    EXPECT_EQ(most == 1000, std::ranges::none_of(shrunk, [](const auto& f) { return f.second.empty(); })) << most;
  }
}

// Two failures in one motion, one after the other. If the minimal spec of the first shows the second as well, the
// second is not shrunk for a bucket of its own. A third failure whose precursor is the second may still lead to one.
TEST_F(RunFamilies, WhatTheMinimalSpecOfAnEarlierFailureShowsTooHasNoBucketOfItsOwn) {
  const Corpus corpus = create(folder_ / "corpus");
  RunConfig config = config_of(20, 2);
  config.draw.characters = {"human"};
  config.shrink.max_evaluations = 60;
  std::map<std::int64_t, std::vector<Family>> families_of;
  const RunResult result = run_fuzz(
      config, generator(), corpus, [](const RunProgress&) {}, [] { return false; },
      [&](const FailingCase& one) { families_of[one.index] = one.families; });
  std::map<std::int64_t, std::vector<Case>> of_case;
  for (const Bucket& bucket : buckets_of(corpus)) {
    const Case min = *read_case(corpus.folder_of(bucket) + "/" + bucket.min);
    of_case[min.provenance.index].push_back(min);
  }
  std::size_t told = 0;
  for (const auto& [index, cases] : of_case)
    for (const Case& before : cases) {
      told += before.co_failures.size();
      for (const Case& after : cases) {
        const int rank = after.provenance.rank;
        const bool is_precursor = families_of.at(index).at(static_cast<std::size_t>(rank)) != family_of(after);
        const bool is_told = std::ranges::find(before.co_failures, family_of(after)) != before.co_failures.end();
        EXPECT_FALSE(is_told && !is_precursor && before.provenance.rank < rank)
            << family_of(before) << ", " << family_of(after);
      }
    }
  EXPECT_GT(told, 0U);
  EXPECT_LT(buckets_of(corpus).size(), result.record.families.size());
  EXPECT_TRUE(fs::is_empty(corpus.folder() + "/leads"));
}

}  // namespace

}  // namespace contort
