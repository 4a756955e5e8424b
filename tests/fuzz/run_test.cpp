// Whole runs: the same corpus for any number of threads, again and again, and nothing lost when something stops them.
#include "fuzz/run.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <set>

#include "corpus/replay.h"
#include "corpus/runs.h"
#include "fuzz/parallel.h"
#include "tests/checks/small_character.h"
#include "tests/corpus/temp_folder.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

// The small character is a hundred times as fast as the stock ones; two slots and a box each fail often enough.
const Library& library() {
  static const Library small_and_stock = [] {
    Library all = stock_library();
    const Library own = small::library();
    all.parts.insert(own.parts.begin(), own.parts.end());
    all.objects.insert(own.objects.begin(), own.objects.end());
    all.characters.insert(own.characters.begin(), own.characters.end());
    return all;
  }();
  return small_and_stock;
}

RunConfig config_of(std::int64_t cases, int jobs) {
  RunConfig config;
  config.draw.characters = {"small"};
  config.seed = 4;
  config.cases = cases;
  config.jobs = jobs;
  config.batch = 16;
  config.shrinks_per_family = 1;
  config.shrink.max_evaluations = 12;
  config.tool = "test";
  return config;
}

Corpus create(const std::string& folder) {
  Result<Corpus> corpus = Corpus::create(folder);
  if (!corpus) ADD_FAILURE() << to_line(corpus.issue());
  return std::move(corpus).value();
}

RunResult run(const RunConfig& config, const Corpus& corpus) {
  return run_fuzz(
      config, library(), corpus, [](const RunProgress&) {}, [] { return false; });
}

std::vector<Bucket> buckets_of(const Corpus& corpus) {
  std::vector<Issue> damaged;
  const std::vector<Bucket> buckets = corpus.buckets(damaged);
  EXPECT_TRUE(damaged.empty());
  return buckets;
}

void expect_all_replay_as_the_same(const Corpus& corpus) {
  Evaluator evaluator;
  for (const Bucket& bucket : buckets_of(corpus))
    for (const std::string& file : {bucket.min, bucket.orig, bucket.worst}) {
      const Result<Case> stored = read_case(corpus.folder_of(bucket) + "/" + file);
      ASSERT_TRUE(stored) << to_line(stored.issue());
      EXPECT_EQ(replay(*stored, library(), evaluator).verdict, Verdict::same) << file;
      EXPECT_EQ(family_of(*stored), bucket.family);
    }
}

void expect_bucket_is_sound(const Corpus& corpus, const Bucket& bucket) {
  const auto read = [&](const std::string& file) { return *read_case(corpus.folder_of(bucket) + "/" + file); };
  const Case min = read(bucket.min), orig = read(bucket.orig), worst = read(bucket.worst);
  EXPECT_GE(worst.expect.depth, min.expect.depth) << bucket.id;
  EXPECT_GE(worst.expect.depth, orig.expect.depth) << bucket.id;
  EXPECT_FALSE(cheaper(orig.spec, min.spec)) << bucket.id;
  EXPECT_EQ(min.provenance.shrunk_from, spec_id(orig.spec)) << bucket.id;
  EXPECT_EQ(bucket_id(bucket.family, features_of(min.spec)), bucket.id);
  EXPECT_EQ(bucket.runs.size(), 1U);
}

class Runs : public testing::Test {
 protected:
  TempFolder folder_;
};
class RunsSlow : public Runs {};

// 300 cases on one thread and on four; one corpus is then run into again.
TEST_F(Runs, OneThreadAndFourLeaveTheSameBytesAndRunningAgainChangesNothing) {
  const Corpus one = create(folder_ / "one"), four = create(folder_ / "four");
  const RunResult first = run(config_of(300, 1), one);
  const RunResult second = run(config_of(300, 4), four);
  const Tree tree = tree_of(one.folder());
  EXPECT_GT(tree.size(), 8U);
  EXPECT_EQ(first_difference(tree, tree_of(four.folder())), "");
  EXPECT_EQ(first.families, second.families);
  EXPECT_EQ(first.tested, second.tested);
  EXPECT_EQ(first.discarded, 0);
  EXPECT_TRUE(first.unconfirmed.empty());
  EXPECT_TRUE(fs::is_empty(one.folder() + "/leads"));
  for (const Bucket& bucket : buckets_of(one)) expect_bucket_is_sound(one, bucket);
  expect_all_replay_as_the_same(one);

  const RunResult again = run(config_of(300, 3), one);
  EXPECT_EQ(first_difference(tree, tree_of(one.folder())), "");
  EXPECT_TRUE(again.new_buckets.empty());
  EXPECT_EQ(again.known_buckets.size(), first.new_buckets.size());
}

TEST_F(Runs, ALongerRunHoldsTheShorterOne) {
  const Corpus corpus = create(folder_ / "short"), whole = create(folder_ / "long");
  run(config_of(32, 2), corpus);
  run(config_of(64, 2), corpus);
  run(config_of(64, 2), whole);
  EXPECT_EQ(first_difference(tree_of(corpus.folder()), tree_of(whole.folder())), "");
}

TEST_F(RunsSlow, OfTheStockCharactersAreTheSameOnOneThreadAndOnThree) {
  const Corpus one = create(folder_ / "one"), three = create(folder_ / "three");
  RunConfig config = config_of(24, 1);
  config.draw.characters = {"human", "mech"};
  config.shrink.max_evaluations = 4;
  run(config, one);
  config.jobs = 3;
  run(config, three);
  EXPECT_EQ(first_difference(tree_of(one.folder()), tree_of(three.folder())), "");
  expect_all_replay_as_the_same(one);
}

TEST_F(Runs, CountWhatTheyDid) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunResult result = run(config_of(40, 2), corpus);
  EXPECT_EQ(result.issue.code, "");
  EXPECT_EQ(result.totals.cases, 40);
  EXPECT_GT(result.totals.failing, 0);
  EXPECT_GT(result.totals.frames, 40 * 6);
  EXPECT_EQ(result.totals.families, static_cast<int>(result.families.size()));
  EXPECT_EQ(result.totals.buckets_new, static_cast<int>(result.new_buckets.size()));
  EXPECT_EQ(result.new_buckets.size(), buckets_of(corpus).size());
  std::int64_t characters = 0;
  for (const auto& [what, count] : result.tested)
    if (what.rfind("character ", 0) == 0) characters += count;
  EXPECT_EQ(characters, 40);
}

TEST_F(Runs, AreRecordedInTheCorpus) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunResult result = run(config_of(20, 2), corpus);
  std::vector<Issue> damaged;
  const std::vector<RunRecord> records = runs_of(corpus, damaged);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].cases, 20);
  EXPECT_EQ(records[0].frames, result.totals.frames);
  EXPECT_EQ(records[0].tested, result.tested);
  ASSERT_EQ(records[0].families.size(), result.families.size());
  for (const auto& [family, count] : records[0].families) {
    EXPECT_EQ(count.cases, result.families.at(family));
    EXPECT_LT(count.first_index, 20);
  }
}

TEST_F(Runs, OfDifferentCharactersAreDifferentRuns) {
  const Corpus corpus = create(folder_ / "corpus");
  for (const char* name : {"small", "human"}) {
    RunConfig config = config_of(1, 1);
    config.draw.characters = {name};
    run(config, corpus);
  }
  std::vector<Issue> damaged;
  EXPECT_EQ(runs_of(corpus, damaged).size(), 2U);
}

TEST_F(Runs, OfNoCasesLeaveAnEmptyCorpus) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunResult result = run(config_of(0, 2), corpus);
  EXPECT_EQ(result.totals.cases, 0);
  EXPECT_TRUE(result.new_buckets.empty());
  EXPECT_EQ(result.issue.code, "");
  EXPECT_FALSE(result.interrupted);
}

TEST_F(Runs, ThatAreStoppedKeepWhatTheyFound) {
  const Corpus corpus = create(folder_ / "corpus");
  std::atomic<int> asked{0};
  RunConfig config = config_of(100000, 2);
  const RunResult result = run_fuzz(
      config, library(), corpus, [](const RunProgress&) {}, [&] { return ++asked > 300; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_LT(result.totals.cases, 1000);
  EXPECT_GT(result.totals.failing, 0);
  EXPECT_EQ(result.new_buckets.size(), buckets_of(corpus).size());
  std::set<std::string> families;
  for (const Bucket& bucket : buckets_of(corpus)) families.insert(bucket.family);
  for (const auto& [family, count] : result.families) EXPECT_EQ(families.count(family), 1U) << family << count;
  expect_all_replay_as_the_same(corpus);
}

TEST_F(Runs, ThatAreStoppedAtOnceHaveNoCases) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunResult result = run_fuzz(
      config_of(100, 2), library(), corpus, [](const RunProgress&) {}, [] { return true; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.totals.cases, 0);
}

TEST_F(Runs, EndWhenTheirTimeIsUp) {
  RunConfig config = config_of(-1, 2);
  config.time_s = 0.3;
  const RunResult result = run(config, create(folder_ / "corpus"));
  EXPECT_FALSE(result.interrupted);
  EXPECT_GT(result.totals.cases, 0);
  EXPECT_GE(result.totals.elapsed_s, 0.3);
  EXPECT_LT(result.totals.elapsed_s, 30.0);
}

// Root may write everywhere, so the corpus is broken by putting a file where its leads go.
TEST_F(Runs, WhoseCorpusBreaksMidwayEndWithAnIssue) {
  const Corpus corpus = create(folder_ / "corpus");
  std::atomic<bool> broken{false};
  const RunResult result = run_fuzz(
      config_of(2000, 2), library(), corpus,
      [&](const RunProgress& p) {
        if (p.cases < 16 || broken.exchange(true)) return;
        fs::remove_all(corpus.folder() + "/leads");
        spill(corpus.folder() + "/leads", "in the way");
      },
      [] { return false; });
  EXPECT_EQ(result.issue.code, "file.unwritable");
  EXPECT_LT(result.totals.cases, 2000);
  expect_all_replay_as_the_same(corpus);
}

TEST_F(Runs, ReportADamagedBucketInsteadOfOverwritingIt) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunResult before = run(config_of(20, 1), corpus);
  ASSERT_FALSE(before.new_buckets.empty());
  spill(before.new_buckets[0] + "/bucket.json", "{");
  const RunResult result = run(config_of(20, 1), corpus);
  EXPECT_NE(result.issue.code, "");
  EXPECT_EQ(slurp(before.new_buckets[0] + "/bucket.json"), "{");
}

TEST(ParallelFor, DoesEveryIndexOnceForAnyNumberOfThreads) {
  for (const int jobs : {1, 2, 7}) {
    std::vector<std::atomic<int>> done(100);
    std::atomic<int> wrong_worker{0};
    parallel_for(
        jobs, 100,
        [&](int worker, int index) {
          if (worker < 0 || worker >= jobs) ++wrong_worker;
          ++done[static_cast<std::size_t>(index)];
        },
        [] {});
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
    EXPECT_EQ(wrong_worker, 0);
  }
}

TEST(ParallelFor, NothingToDoIsDoneAtOnce) {
  parallel_for(
      4, 0, [](int, int) { FAIL(); }, [] { FAIL(); });
}

}  // namespace

}  // namespace contort
