// Whole runs: the same corpus for any number of workers and shards, with or without interruption, and nothing lost.
#include "fuzz/run.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>

#include "corpus/leads.h"
#include "corpus/runs.h"
#include "fuzz/profile_violations.h"
#include "fuzz/run_state.h"
#include "model/core/files.h"
#include "tests/checks/family_text.h"
#include "tests/corpus/sample_cases.h"
#include "tests/fuzz/small_runs.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

namespace fs = std::filesystem;
using namespace small_runs;

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
  EXPECT_EQ(first.record.families, second.record.families);
  EXPECT_EQ(first.record.tested, second.record.tested);
  EXPECT_EQ(first.record.discarded, 0);
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
  EXPECT_EQ(result.record.cases, 40);
  EXPECT_GT(result.record.failing, 0);
  EXPECT_GT(result.record.frames, 40 * 6);
  EXPECT_EQ(result.new_buckets.size(), buckets_of(corpus).size());
  std::int64_t characters = 0;
  for (const auto& [what, count] : result.record.tested)
    if (what.rfind("character ", 0) == 0) characters += count;
  EXPECT_EQ(characters, 40);
}

TEST_F(Runs, AreRecordedInTheCorpus) {
  const Corpus corpus = create(folder_ / "corpus");
  RunConfig config = config_of(20, 2);
  config.shrinks_per_case = 1000;
  const RunResult result = run(config, corpus);
  std::vector<Issue> damaged;
  const std::vector<RunRecord> records = runs_of(corpus, damaged);
  EXPECT_EQ(records, std::vector<RunRecord>{result.record});
  EXPECT_EQ(result.record.cases, 20);
  std::int64_t of_arms = 0;
  for (const auto& [arm, count] : result.record.arms) of_arms += count.cases;
  EXPECT_EQ(of_arms, 20);
  for (const auto& [family, count] : result.record.families) {
    ASSERT_EQ(count.first_indices.size(), 1U) << "as many as are shrunk";
    EXPECT_LT(count.first_indices.front(), 20);
    EXPECT_TRUE(result.record.arms.contains(count.first_arm)) << count.first_arm;
  }
}

TEST_F(Runs, WithoutGuidanceAreEven) {
  RunConfig config = config_of(600, 2);
  config.draw.profile.guided = 0.0, config.draw.profile.uniform = 1.0;
  const RunResult result = run(config, create(folder_ / "even"));
  ASSERT_EQ(result.record.arms.size(), 1U);
  EXPECT_EQ(result.record.arms.at("uniform").cases, 600);
  EXPECT_NE(run_name(config), run_name(config_of(600, 2)));
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
  EXPECT_EQ(result.record.cases, 0);
  EXPECT_TRUE(result.new_buckets.empty());
  EXPECT_EQ(result.issue.code, "");
  EXPECT_FALSE(result.interrupted);
}

TEST_F(Runs, ThatAreStoppedAndResumedAgainAndAgainLeaveTheSameBytes) {
  expect_resuming_changes_nothing(folder_, config_of(600, 2), 3);
}

TEST_F(Runs, ShrinkWithinTheirProfile) {
  const Corpus corpus = create(folder_ / "corpus");
  RunConfig config = config_of(200, 2);
  config.draw.profile.name = "long", config.draw.profile.shortest_frames = 60;
  config.shrink.max_evaluations = 60;
  run(config, corpus);
  std::vector<Issue> damaged;
  const std::vector<Bucket> buckets = corpus.buckets(damaged);
  EXPECT_FALSE(buckets.empty());
  for (const Bucket& bucket : buckets)
    for (const std::string& file : {bucket.min, bucket.worst}) {
      const Case stored = read_case(corpus.folder_of(bucket) + "/" + file).value();
      EXPECT_EQ(profile_violations(stored.spec, config.draw.profile, generator()), 0) << pretty_spec(stored.spec);
      EXPECT_EQ(stored.provenance.profile, "long");
    }
}

// A process that was killed between writing and renaming: its file stayed for good, and the folder with it.
TEST_F(Runs, RemoveWhatWasLeftHalfWritten) {
  const Corpus whole = create(folder_ / "whole"), broken = create(folder_ / "broken");
  const RunConfig config = config_of(200, 2);
  run(config, whole);
  const std::string leads = broken.folder() + "/leads/" + run_name(config);
  ASSERT_TRUE(make_folder(leads));
  spill(leads + "/0195173a7857-0000000000000014.json.27217.part", "{");
  const std::string bucket = broken.folder_of(buckets_of(whole).front());
  ASSERT_TRUE(make_folder(bucket));
  spill(bucket + "/bucket.json.27217.part", "{");
  spill(broken.folder() + "/runs/" + run_name(config) + ".state.27217.part", "{");
  run(config, broken);
  EXPECT_EQ(first_difference(tree_of(whole.folder()), tree_of(broken.folder())), "");
}

TEST_F(Runs, ResumedWithOtherOptionsAreRefused) {
  const Corpus corpus = create(folder_ / "corpus");
  RunConfig config = config_of(100000, 2);
  EXPECT_TRUE(run_until(300, config, corpus).interrupted);
  config.resume = true;
  config.shrinks_per_family = 7;
  const RunResult refused = run(config, corpus);
  EXPECT_EQ(refused.issue.code, "state.other_plan");
  EXPECT_EQ(refused.record.cases, 0);
}

TEST_F(Runs, ThatAreStoppedTellHowManyFailuresTheyLeave) {
  const Corpus corpus = create(folder_ / "corpus");
  EXPECT_EQ(unsettled_failures(corpus), 0);
  bool has_failure = false;
  const RunResult stopped = run_fuzz(
      config_of(100000, 2), generator(), corpus, [&](const RunProgress& p) { has_failure |= p.shrinking > 0; },
      [&] { return has_failure; });
  ASSERT_TRUE(stopped.interrupted);
  EXPECT_GT(stopped.unsettled, 0);
  EXPECT_EQ(unsettled_failures(corpus), stopped.unsettled);
}

TEST_F(Runs, OfTheSameNameDoNotRunTwiceAtATime) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunConfig config = config_of(8, 1);
  RunRecord record;
  record.name = run_name(config);
  {
    const Result<RunLock> lock = RunLock::take(corpus, record);
    ASSERT_TRUE(lock);
    EXPECT_EQ(run(config, corpus).issue.code, "run.busy");
  }
  EXPECT_EQ(run(config, corpus).issue.code, "");
}

std::vector<pid_t> children() {
  std::vector<pid_t> all;
  const std::string me = std::to_string(::getpid());
  std::istringstream list(slurp("/proc/" + me + "/task/" + me + "/children"));
  for (pid_t pid = 0; list >> pid;) all.push_back(pid);
  return all;
}

// Kills a worker each time the run has asked this many times whether to stop.
RunResult run_disturbed(const RunConfig& config, const Corpus& corpus, int every) {
  int asked = 0;
  return run_fuzz(
      config, generator(), corpus, [](const RunProgress&) {},
      [&] {
        if (++asked % every == 0 && !children().empty()) ::kill(children().front(), SIGKILL);
        return false;
      });
}

// A suite, and so a process, of its own: this test kills children of its process.
using DisturbedRuns = Runs;

// Killed from outside, for example for lack of memory: it does not happen again, so it is no failure of the case.
TEST_F(DisturbedRuns, JudgeACaseWhoseWorkerWasKilledByItsSecondRun) {
  const Corpus quiet = create(folder_ / "quiet"), disturbed = create(folder_ / "disturbed");
  run(config_of(1000, 2), quiet);
  const RunResult result = run_disturbed(config_of(1000, 2), disturbed, 200);
  EXPECT_EQ(result.issue.code, "");
  ASSERT_FALSE(result.unconfirmed.empty()) << "nobody was killed";
  EXPECT_EQ(tree_of(disturbed.folder() + "/buckets"), tree_of(quiet.folder() + "/buckets"));
  EXPECT_EQ(tree_of(disturbed.folder() + "/runs"), tree_of(quiet.folder() + "/runs"));
  for (const std::string& path : result.unconfirmed) {
    const Result<Lead> lead = read_lead(path);
    ASSERT_TRUE(lead) << to_line(lead.issue());
    EXPECT_EQ(lead->original.expect.check, "crash");
    EXPECT_EQ(lead->original.expect.subject, "SIGKILL");
    EXPECT_TRUE(is_unsteady(*lead));
    EXPECT_TRUE(build_stage(lead->original.spec, library()));
  }
}

// Ten minutes of motion take longer than a tenth of a second, each time. The second run has a whole second in a process
// of its own; the machine decides whether that is enough. The failure is confirmed or not, and stored in either case.
TEST_F(Runs, ACaseThatTakesTooLongIsAFindingThatIsTriedAgain) {
  const Corpus corpus = create(folder_ / "corpus");
  RunConfig config = config_of(1, 1);
  config.seeds = {bent_elbow(100, 36000)};
  config.limits.seconds = 0.1;
  config.shrink.max_evaluations = 3;
  const RunResult result = run(config, corpus);
  EXPECT_EQ(result.record.cases, 1);
  EXPECT_TRUE(result.record.families.contains({"timeout", "human", "evaluation"}));
  ASSERT_EQ(result.unconfirmed.size() + result.new_buckets.size(), 1U);
  const std::vector<Bucket> buckets = buckets_of(corpus);
  const Case stored =
      *read_case(buckets.empty() ? result.unconfirmed.front() : corpus.folder_of(buckets[0]) + "/" + buckets[0].min);
  EXPECT_EQ(stored.expect.check, "timeout");
  EXPECT_EQ(stored.expect.limit_s, 1);
}

TEST_F(Runs, OfAShardThatWasStoppedAreMissingUntilItIsResumed) {
  const Corpus whole = create(folder_ / "whole"), into = create(folder_ / "into");
  run(config_of(600, 2), whole);
  const Corpus shards[] = {create(folder_ / "0"), create(folder_ / "1")};
  RunConfig config = config_of(600, 1);
  config.shard = {0, 2};
  run(config, shards[0]);
  config.shard = {1, 2};
  ASSERT_TRUE(run_until(60, config, shards[1]).interrupted);
  EXPECT_EQ(merge({shards[0], shards[1]}, into)->incomplete.size(), 1U);
  config.resume = true;
  EXPECT_FALSE(run(config, shards[1]).interrupted);
  EXPECT_TRUE(merge({shards[1]}, into)->incomplete.empty());
  EXPECT_EQ(first_difference(tree_of(whole.folder()), tree_of(into.folder())), "");
}

TEST_F(Runs, OfThreeShardsMergeToOneRun) { expect_shards_make_one_run(folder_, config_of(300, 2), 3); }
TEST_F(RunsSlow, OfSixteenShardsMergeToOneRun) { expect_shards_make_one_run(folder_, config_of(2000, 2), 16); }

TEST_F(Runs, ThatAreStoppedAtOnceHaveNoCases) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunResult result = run_fuzz(
      config_of(100, 2), generator(), corpus, [](const RunProgress&) {}, [] { return true; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.record.cases, 0);
}

// Root may write everywhere, so the corpus is broken by putting a file where its leads go.
TEST_F(Runs, WhoseCorpusBreaksMidwayEndWithAnIssue) {
  const Corpus corpus = create(folder_ / "corpus");
  std::atomic<bool> broken{false};
  const RunResult result = run_fuzz(
      config_of(2000, 2), generator(), corpus,
      [&](const RunProgress& p) {
        if (p.cases < 16 || broken.exchange(true)) return;
        fs::remove_all(corpus.folder() + "/leads");
        spill(corpus.folder() + "/leads", "in the way");
      },
      [] { return false; });
  EXPECT_EQ(result.issue.code, "file.unwritable");
  EXPECT_LT(result.record.cases, 2000);
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

}  // namespace

}  // namespace contort
