// A spec that ends its process only while something else is shrunk is found all the same.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "corpus/runs.h"
#include "tests/checks/family_text.h"
#include "tests/corpus/sample_cases.h"
#include "tests/fuzz/small_runs.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

namespace fs = std::filesystem;
using namespace small_runs;

class RunCrashes : public testing::Test {
 protected:
  TempFolder folder_;
};

int actions_of(const Spec& spec) {
  int count = 0;
  for (const SequenceDesc& sequence : spec.sequences)
    for (const ClipDesc& clip : sequence.clips) count += static_cast<int>(clip.actions.size());
  return count;
}

// No drawn case crashes. A case that has been shrunk to one action and few bytes does.
constexpr std::size_t kFewBytes = 240;
RunConfig config_with_crash(std::int64_t cases, int jobs) {
  RunConfig config = config_of(cases, jobs);
  config.shrink.max_evaluations = 60;
  config.shrink.before_run = [](const Spec& spec) {
    if (actions_of(spec) == 1 && print_spec(spec).size() < kFewBytes) ::raise(SIGUSR1);
  };
  return config;
}
const Family kCrash{"crash", "small", "SIGUSR1"};

// The greatest memory of a process that starts like a worker, with this process' memory.
std::int64_t most_bytes_of(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::_exit(0);
  }
  rusage used{};
  EXPECT_EQ(::wait4(child, nullptr, 0, &used), child);
  return std::int64_t{used.ru_maxrss} << 10;
}

// Ten minutes of dynamics need some 70 MB in addition to the memory at a worker's start, more with a sanitizer. Half of
// this is the limit.
TEST_F(RunCrashes, ACaseThatNeedsTooMuchMemoryIsAFindingWithItsLimit) {
  const Corpus corpus = create(folder_ / "corpus");
  RunConfig config = config_of(1, 1);
  config.seeds = {bent_elbow(100, 36000)};
  config.seeds[0].dynamics.mode = Mode::tracking;
  const Result<Stage> stage = build_stage(config.seeds[0], library());
  ASSERT_TRUE(stage);
  const std::int64_t idle = most_bytes_of([] {}), busy = most_bytes_of([&] { StageEvaluator().run(*stage); });
  ASSERT_GT(busy, idle + (32 << 20));
  config.limits.bytes = idle + (busy - idle) / 2;
  config.limits.seconds = 60.0;
  config.shrink.max_evaluations = 3;
  const RunResult result = run(config, corpus);
  EXPECT_EQ(result.issue.code, "");
  EXPECT_TRUE(result.record.families.contains({"memory", "human", "evaluation"}));
  ASSERT_EQ(result.new_buckets.size(), 1U);
  const Bucket bucket = buckets_of(corpus).front();
  const Case min = *read_case(corpus.folder_of(bucket) + "/" + bucket.min);
  EXPECT_EQ(min.expect.check, "memory");
  EXPECT_EQ(min.expect.limit_MB, static_cast<int>(config.limits.bytes >> 20));
}

TEST_F(RunCrashes, FindWhatCrashesOnlyWhileItIsShrunk) {
  const Corpus one = create(folder_ / "one"), three = create(folder_ / "three");
  const RunResult result = run(config_with_crash(32, 1), one);
  EXPECT_EQ(result.issue.code, "");
  EXPECT_TRUE(result.unconfirmed.empty());
  EXPECT_FALSE(result.record.families.contains(kCrash)) << "no case has shown it";
  const std::vector<Bucket> buckets = buckets_of(one);
  const auto crash = std::ranges::find(buckets, kCrash, &Bucket::family);
  ASSERT_NE(crash, buckets.end());
  EXPECT_NE(std::ranges::find(result.new_buckets, one.folder_of(*crash)), result.new_buckets.end());
  const Case min = *read_case(one.folder_of(*crash) + "/" + crash->min);
  EXPECT_EQ(actions_of(min.spec), 1);
  EXPECT_TRUE(result.record.families.contains(min.provenance.met_shrinking)) << min.provenance.met_shrinking;
  for (const Bucket& bucket : buckets) {
    if (bucket.family == kCrash) continue;
    EXPECT_GT(read_case(one.folder_of(bucket) + "/" + bucket.min)->provenance.shrink_evaluations, 2) << bucket.family;
  }

  run(config_with_crash(32, 3), three);
  EXPECT_EQ(first_difference(tree_of(one.folder()), tree_of(three.folder())), "");
}

TEST_F(RunCrashes, ThatWereStoppedFindTheSameCrashesInShrinking) {
  const Corpus whole = create(folder_ / "whole"), broken = create(folder_ / "broken");
  RunConfig config = config_with_crash(32, 2);
  run(config, whole);
  config.resume = true;
  for (int stops = 1; run_until(40 * stops, config, broken).interrupted; ++stops) ASSERT_LT(stops, 200);
  EXPECT_EQ(first_difference(tree_of(whole.folder()), tree_of(broken.folder())), "");
}

// It crashes only once, so nothing more is known than the spec at that time.
TEST_F(RunCrashes, ListACrashInShrinkingThatDoesNotHappenAgain) {
  const Corpus corpus = create(folder_ / "corpus"), quiet = create(folder_ / "quiet");
  RunConfig config = config_of(64, 1);
  run(config, quiet);
  const std::string mark = folder_ / "mark";
  config.shrink.before_run = [mark](const Spec&) {
    if (!fs::exists(mark)) spill(mark, ""), ::raise(SIGUSR1);
  };
  const RunResult result = run(config, corpus);
  ASSERT_EQ(result.unconfirmed.size(), 1U);
  const Result<Case> lead = read_case(result.unconfirmed.front());
  ASSERT_TRUE(lead) << to_line(lead.issue());
  EXPECT_EQ(family_of(*lead), kCrash);
  EXPECT_TRUE(result.record.families.contains(lead->provenance.met_shrinking));
  fs::remove(result.unconfirmed.front());
  EXPECT_EQ(first_difference(tree_of(quiet.folder()), tree_of(corpus.folder())), "");
}

TEST_F(RunCrashes, OfThreeShardsMergeTheirCrashesInShrinking) {
  expect_shards_make_one_run(folder_, config_with_crash(32, 2), 3);
}

}  // namespace

}  // namespace contort
