// Runs that begin with specs of the user.
#include <gtest/gtest.h>

#include "corpus/runs.h"
#include "tests/corpus/sample_cases.h"
#include "tests/fuzz/small_runs.h"

namespace contort {

namespace {

using namespace small_runs;

class RunSeeds : public testing::Test {
 protected:
  TempFolder folder_;
};

// Two of them lift the arm too far.
std::vector<Spec> failing_seeds() {
  std::vector<Spec> seeds;
  for (const double lift_deg : {10.0, 70.0, 80.0})
    seeds.push_back(spec_of({pose_use("arm_left", {{"lift_deg", lift_deg}})}, "small"));
  return seeds;
}

TEST_F(RunSeeds, BeginWithTheirSeeds) {
  const Corpus corpus = create(folder_ / "corpus");
  RunConfig config = config_of(3, 2);
  config.seeds = failing_seeds();
  const RunResult result = run(config, corpus);
  EXPECT_EQ(result.issue.code, "");
  EXPECT_EQ(result.record.arms, (std::map<std::string, StrategyCount>{{"seed", {3, 2}}}));
  const auto family = result.record.families.find({"joint_range", "small", "arm_left/lift max"});
  ASSERT_NE(family, result.record.families.end());
  EXPECT_EQ(family->second.first_indices, std::vector<std::int64_t>{1});
  expect_all_replay_as_the_same(corpus);
  config.seeds.pop_back();
  EXPECT_NE(run_name(config), result.record.name) << "other seeds, another run";
}

TEST_F(RunSeeds, WithSeedsMergeToOneRun) {
  RunConfig config = config_of(600, 2);
  config.seeds = failing_seeds();
  for (int i = 0; i < 20; ++i) config.seeds.push_back(config.seeds[static_cast<std::size_t>(i % 3)]);
  expect_shards_make_one_run(folder_, config, 3);
}

}  // namespace

}  // namespace contort
