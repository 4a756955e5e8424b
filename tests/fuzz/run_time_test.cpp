// Runs with limited time: failures that they did not reach wait for the next run.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "corpus/leads.h"
#include "fuzz/run_state.h"
#include "tests/checks/family_text.h"
#include "tests/fuzz/small_runs.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

using namespace small_runs;

class TimedRuns : public testing::Test {
 protected:
  TempFolder folder_;
};

// A family that came with another one has no bucket for it.
bool is_told(const Family& family, const Corpus& corpus) {
  return std::ranges::any_of(buckets_of(corpus), [&](const Bucket& bucket) {
    const Case min = *read_case(corpus.folder_of(bucket) + "/" + bucket.min);
    return std::ranges::find(min.co_failures, family) != min.co_failures.end();
  });
}

std::set<Family> families_in(const Corpus& corpus) {
  std::set<Family> families;
  for (const Bucket& bucket : buckets_of(corpus)) families.insert(bucket.family);
  return families;
}

// The first of these runs that found a failure and had no time to shrink it; the speed of the machine is unknown.
RunResult run_out_of_time(const Corpus& corpus) {
  RunConfig config = config_of(-1, 2);
  config.shrink.before_run = [](const Spec&) { ::usleep(50'000); };
  for (config.time_s = 0.1; config.time_s < 60.0; config.time_s *= 2.0) {
    std::filesystem::remove_all(corpus.folder());
    const RunResult result = run(config, create(corpus.folder()));
    EXPECT_EQ(result.issue.code, "");
    if (!result.waiting.empty()) return result;
  }
  ADD_FAILURE() << "nothing waits";
  return {};
}

// Failures that time did not reach are neither lost nor another run's by its seed: the next run makes buckets of them.
TEST_F(TimedRuns, LeaveWhatTimeDidNotReachToTheNext) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunResult first = run_out_of_time(corpus);
  std::set<Family> waiting, told = families_in(corpus);
  for (const std::string& path : first.waiting) {
    const Result<Lead> lead = read_lead(path);
    ASSERT_TRUE(lead) << to_line(lead.issue());
    EXPECT_TRUE(waits(*lead));
    Evaluator evaluator(generator());
    EXPECT_EQ(replay(lead->original, evaluator).verdict, Verdict::same);
    waiting.insert(family_of(lead->original));
  }
  for (const auto& [family, count] : first.record.families)
    EXPECT_TRUE(count.first_indices.empty() || waiting.contains(family) || told.contains(family) ||
                is_told(family, corpus))
        << family;
  EXPECT_FALSE(std::filesystem::exists(state_path(corpus, first.record))) << "it ended as it was asked to";
  RunConfig next = config_of(4, 2);
  next.seed = 5;
  const RunResult second = run(next, corpus);
  EXPECT_TRUE(second.waiting.empty());
  EXPECT_TRUE(std::filesystem::is_empty(corpus.folder() + "/leads"));
  told = families_in(corpus);
  for (const Family& family : waiting) EXPECT_TRUE(told.contains(family)) << family;
  expect_all_replay_as_the_same(corpus);
}

// The first run stored them, whichever run shrinks them.
TEST_F(TimedRuns, FileWhatWaitedUnderTheNameOfItsRun) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunResult first = run_out_of_time(corpus);
  ASSERT_FALSE(first.waiting.empty());
  RunConfig next = config_of(0, 1);
  next.seed = 5;
  const std::size_t filed = run(next, corpus).new_buckets.size();
  EXPECT_EQ(filed + first.new_buckets.size(), buckets_of(corpus).size());
  EXPECT_GE(filed, 1U);
  for (const Bucket& bucket : buckets_of(corpus)) EXPECT_EQ(bucket.runs, std::vector<std::string>{first.record.name});
}

TEST_F(TimedRuns, EndWhenTheirTimeIsUp) {
  RunConfig config = config_of(-1, 2);
  config.time_s = 0.3;
  const RunResult result = run(config, create(folder_ / "corpus"));
  EXPECT_FALSE(result.interrupted);
  EXPECT_GT(result.record.cases, 0);
  EXPECT_GE(result.elapsed_s, 0.3);
  EXPECT_LT(result.elapsed_s, 30.0);
}

}  // namespace

}  // namespace contort
