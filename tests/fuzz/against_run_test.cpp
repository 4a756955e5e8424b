// Whole runs that compare two builds: which failures count and are stored, with the same result for any number of
// workers.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "corpus/runs.h"
#include "tests/checks/family_text.h"
#include "tests/fuzz/two_builds.h"

namespace contort {
namespace {

using namespace two_builds;
using small_runs::buckets_of;
using small_runs::create;
using swing::SwingGenerator;

class AgainstRuns : public testing::Test {
 protected:
  RunResult run_faulty(const RunConfig& config, const Corpus& corpus) { return run_compared(config, wide_, corpus); }
  TempFolder folder_;
  WideSwingGenerator wide_;
  SwingGenerator swing_;
};

bool shows_family(Generator& generator, const Spec& spec, const Family& family) {
  Evaluator evaluator(generator);
  const Result<Evaluation> evaluation = evaluator.run(spec);
  return evaluation && deepest(evaluation->findings, family.check, family.subject) != nullptr;
}

std::int64_t all_counts(const AgainstCounts& counts) { return counts.same + counts.moved + counts.refused; }

TEST_F(AgainstRuns, OfEqualBuildsFindNothing) {
  const Corpus corpus = create(folder_ / "corpus"), alone = create(folder_ / "alone");
  const RunResult result = run_compared(compared_config(60, 2), swing_, corpus);
  EXPECT_EQ(result.issue.code, "");
  EXPECT_EQ(result.record.failing, 0);
  ASSERT_TRUE(result.record.against);
  EXPECT_EQ(result.record.against->same, 60);
  EXPECT_EQ(all_counts(*result.record.against), 60);
  EXPECT_TRUE(buckets_of(corpus).empty());
  RunConfig uncompared = compared_config(60, 2);
  uncompared.against.reset();
  EXPECT_GT(run_compared(uncompared, swing_, alone).record.failing, 30) << "failures that both builds have";
}

TEST_F(AgainstRuns, StoreCasesThatFailHereAndPassInTheBase) {
  const Corpus corpus = create(folder_ / "corpus");
  const RunResult result = run_faulty(compared_config(60, 2), corpus);
  EXPECT_EQ(result.issue.code, "");
  EXPECT_TRUE(result.unconfirmed.empty());
  ASSERT_FALSE(result.new_buckets.empty());
  for (const Bucket& bucket : buckets_of(corpus))
    for (const std::string& file : {bucket.min, bucket.orig}) {
      const Case stored = *read_case(corpus.folder_of(bucket) + "/" + file);
      EXPECT_EQ(stored.provenance.base, "0.0 0123456789abcdef") << file;
      EXPECT_TRUE(shows_family(wide_, stored.spec, bucket.family)) << bucket.family << " " << file;
      const bool is_milder = stored.provenance.base_shows == "milder";
      EXPECT_EQ(shows_family(swing_, stored.spec, bucket.family), is_milder) << bucket.family << " " << file;
      EXPECT_EQ(stored.provenance.base_margin < 0.0, is_milder);
    }
}

TEST_F(AgainstRuns, ShrinkAFastSwingToOneThatTheBaseDoesSlowly) {
  const Corpus corpus = create(folder_ / "corpus");
  run_faulty(compared_config(60, 2), corpus);
  int speeds = 0;
  for (const Bucket& bucket : buckets_of(corpus)) {
    if (bucket.check != "angular_velocity") continue;
    ++speeds;
    const Case min = *read_case(corpus.folder_of(bucket) + "/" + bucket.min);
    EXPECT_EQ(min.provenance.base_shows, "passes_check");
    EXPECT_GT(min.provenance.base_margin, 0.0);
    ASSERT_EQ(min.spec.sequences.size(), 1U);
    ASSERT_EQ(min.spec.sequences[0].clips.size(), 1U);
    const std::vector<ActionUse>& uses = min.spec.sequences[0].clips[0].actions;
    EXPECT_LE(uses.size(), 2U) << "the wide swing, and at most the one before it";
    EXPECT_TRUE(std::ranges::any_of(
        uses, [](const ActionUse& use) { return std::get<double>(use.params.at("angle_deg")) < -115.0; }));
  }
  EXPECT_GE(speeds, 1);
}

TEST_F(AgainstRuns, CountEachCase) {
  const RunResult result = run_faulty(compared_config(60, 2), create(folder_ / "corpus"));
  const AgainstCounts& counts = *result.record.against;
  EXPECT_GT(counts.broke, 0);
  EXPECT_GT(counts.same, 0) << "some draws have no wide swing";
  EXPECT_EQ(counts.refused, 0);
  EXPECT_GE(counts.broke + counts.worse + counts.mended + all_counts(counts), 60);
  EXPECT_LE(result.record.failing, counts.broke + counts.worse);
  EXPECT_GE(result.record.failing, std::max(counts.broke, counts.worse));
}

TEST_F(AgainstRuns, LeaveTheSameBytesForAnyNumberOfWorkersAndStops) {
  const Corpus one = create(folder_ / "one"), three = create(folder_ / "three"), stopped = create(folder_ / "stopped");
  const RunResult result = run_faulty(compared_config(60, 1), one);
  EXPECT_EQ(run_faulty(compared_config(60, 3), three).record, result.record);
  EXPECT_GT(tree_of(one.folder()).size(), 4U);
  EXPECT_EQ(first_difference(tree_of(one.folder()), tree_of(three.folder())), "");

  RunConfig config = compared_config(60, 2);
  config.resume = true;
  for (int stops = 1, asked = 0;; ++stops, asked = 0) {
    ASSERT_LT(stops, 200);
    const RunResult part = run_fuzz(
        config, wide_, stopped, [](const RunProgress&) {}, [&] { return ++asked > 20 * stops; });
    if (!part.interrupted) break;
  }
  EXPECT_EQ(first_difference(tree_of(one.folder()), tree_of(stopped.folder())), "");
}

TEST_F(AgainstRuns, AddUpOverShards) {
  const Corpus whole = create(folder_ / "whole"), into = create(folder_ / "merged");
  run_faulty(compared_config(60, 2), whole);
  std::vector<Corpus> shards;
  for (int i = 0; i < 3; ++i) {
    RunConfig config = compared_config(60, 2);
    config.shard = {i, 3};
    shards.push_back(create(folder_ / std::to_string(i)));
    run_faulty(config, shards.back());
  }
  const Result<Merged> merged = merge(shards, into);
  ASSERT_TRUE(merged) << to_line(merged.issue());
  EXPECT_EQ(first_difference(tree_of(whole.folder()), tree_of(into.folder())), "");
}

// The cases are the same as without a base, because draws must not depend on the other build.
TEST_F(AgainstRuns, DrawTheSameCasesAsWithoutABase) {
  RunConfig alone = compared_config(300, 2);
  alone.against.reset();
  alone.shrinks_per_case = 1, alone.shrink.max_evaluations = 0;
  RunConfig both = alone;
  both.against = against_base(sound_swing);
  const RunRecord without = run_faulty(alone, create(folder_ / "alone")).record;
  const RunRecord with = run_faulty(both, create(folder_ / "both")).record;
  EXPECT_EQ(with.tested, without.tested);
  EXPECT_EQ(with.frames, without.frames);
  EXPECT_LT(with.failing, without.failing);
}

TEST_F(AgainstRuns, GoOnWhereTheBaseRefuses) {
  const Corpus corpus = create(folder_ / "corpus");
  RunConfig config = compared_config(60, 2);
  config.against = against_base(sound_swing, [](const Spec& spec) -> std::optional<Issue> {
    if (spec.sequences.size() < 2) return std::nullopt;
    return Issue{"base.crash", "", "the base ended: SIGSEGV"};
  });
  const RunResult result = run_faulty(config, corpus);
  EXPECT_EQ(result.issue.code, "");
  const AgainstCounts& counts = *result.record.against;
  EXPECT_GT(counts.refused, 0);
  EXPECT_LT(counts.refused, 60);
  EXPECT_GE(counts.first_refused, 0);
  EXPECT_EQ(counts.first_refusal, "base.crash: the base ended: SIGSEGV");
  EXPECT_TRUE(result.unconfirmed.empty());
  for (const Bucket& bucket : buckets_of(corpus))
    EXPECT_LT(read_case(corpus.folder_of(bucket) + "/" + bucket.orig)->spec.sequences.size(), 2U);
}

// It ends its process if a motion has many frames.
struct Crash {
  void operator()(const Motion& motion) const {
    if (motion.frame_count > 12) ::raise(SIGUSR1);
  }
};
using CrashingGenerator = ChangedSwing<Crash>;

const Family kUserSignal{"crash", "pendulum", "SIGUSR1"};

TEST_F(AgainstRuns, CountACrashThatTheBaseDoesNotHave) {
  const Corpus corpus = create(folder_ / "corpus");
  CrashingGenerator crashing;
  const RunResult result = run_compared(compared_config(30, 2), crashing, corpus);
  EXPECT_EQ(result.issue.code, "");
  EXPECT_GT(result.record.against->broke, 0);
  ASSERT_EQ(result.record.families.size(), 1U);
  EXPECT_EQ(result.record.families.begin()->first, kUserSignal);
  const std::vector<Bucket> buckets = buckets_of(corpus);
  ASSERT_EQ(buckets.size(), 1U);
  const Case min = *read_case(corpus.folder_of(buckets[0]) + "/" + buckets[0].min);
  EXPECT_EQ(min.provenance.base_shows, "passes_check");
  EXPECT_EQ(swing_.admit(min.spec)->most_frames, 13);
}

TEST_F(AgainstRuns, CountNoCrashThatTheBaseHasToo) {
  const Corpus corpus = create(folder_ / "corpus");
  CrashingGenerator crashing;
  RunConfig config = compared_config(30, 2);
  config.against = against_base(sound_swing, [](const Spec& spec) -> std::optional<Issue> {
    SwingGenerator swing;
    if (swing.admit(spec)->most_frames <= 12) return std::nullopt;
    return Issue{"base.crash", "", "the base ended: SIGUSR1"};
  });
  const RunResult result = run_compared(config, crashing, corpus);
  EXPECT_GT(result.record.against->refused, 0);
  EXPECT_EQ(result.record.against->broke, 0);
  EXPECT_TRUE(result.record.families.empty());
  EXPECT_TRUE(result.unconfirmed.empty());
  EXPECT_TRUE(buckets_of(corpus).empty());
}

// A base whose every second answer differs gives no comparison; each failure is listed as not confirmed.
TEST_F(AgainstRuns, ListWhatTheBaseDoesNotRepeat) {
  const Corpus corpus = create(folder_ / "corpus");
  RunConfig config = compared_config(20, 1);
  const auto counter = std::make_shared<int>(0);
  config.against->start = [counter] {
    class Unsteady final : public BaseBuild {
     public:
      explicit Unsteady(std::shared_ptr<int> count) : count_(std::move(count)), inner_(sound_swing()) {}
      void ask(const MeasureRequest& request) override { inner_.ask(request); }
      Measurement answer(const std::function<void()>& on_wait) override {
        Measurement measured = inner_.answer(on_wait);
        measured.motion_hash = std::string(15, '0') + "01"[++*count_ % 2];
        return measured;
      }

     private:
      std::shared_ptr<int> count_;
      GeneratorBase inner_;
    };
    return std::make_unique<Unsteady>(counter);
  };
  const RunResult result = run_faulty(config, corpus);
  EXPECT_GT(result.record.against->broke, 0);
  EXPECT_FALSE(result.unconfirmed.empty());
}

}  // namespace
}  // namespace contort
