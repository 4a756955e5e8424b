// Runs of a small character for tests. It is a hundred times as fast as the stock ones; two slots and a box each fail
// often enough.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "corpus/merge.h"
#include "corpus/replay.h"
#include "fuzz/run.h"
#include "tests/checks/small_character.h"
#include "tests/corpus/temp_folder.h"
#include "tests/stage_evaluator.h"

namespace contort::small_runs {

inline const Library& library() {
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

inline Generator& generator() {
  static BuiltInGenerator built_in(library());
  return built_in;
}

inline RunConfig config_of(std::int64_t cases, int jobs) {
  RunConfig config;
  config.draw.characters = {"small"};
  config.draw.profile.staged = false;  // all at once, so that much fails early
  config.draw.profile.wild_poses = true;
  config.seed = 4;
  config.cases = cases;
  config.jobs = jobs;
  config.shrinks_per_family = 1;
  config.shrink.max_evaluations = 12;
  config.tool = "test";
  config.limits.seconds = 120.0;  // with sanitizers, on a busy machine, a case may take longer than the default limit
  return config;
}

inline Corpus create(const std::string& folder) {
  Result<Corpus> corpus = Corpus::create(folder);
  if (!corpus) ADD_FAILURE() << to_line(corpus.issue());
  return std::move(corpus).value();
}

inline RunResult run(const RunConfig& config, const Corpus& corpus) {
  return run_fuzz(
      config, generator(), corpus, [](const RunProgress&) {}, [] { return false; });
}

inline std::vector<Bucket> buckets_of(const Corpus& corpus) {
  std::vector<Issue> damaged;
  const std::vector<Bucket> buckets = corpus.buckets(damaged);
  EXPECT_TRUE(damaged.empty());
  return buckets;
}

inline void expect_all_replay_as_the_same(const Corpus& corpus) {
  Evaluator evaluator(generator());
  for (const Bucket& bucket : buckets_of(corpus))
    for (const std::string& file : {bucket.min, bucket.orig, bucket.worst}) {
      const Result<Case> stored = read_case(corpus.folder_of(bucket) + "/" + file);
      ASSERT_TRUE(stored) << to_line(stored.issue());
      EXPECT_EQ(replay(*stored, evaluator).verdict, Verdict::same) << file;
      EXPECT_EQ(family_of(*stored), bucket.family);
    }
}

// Runs, and is stopped after it has asked this many times whether to stop, as by a user's interrupt.
inline RunResult run_until(int questions, const RunConfig& config, const Corpus& corpus) {
  int asked = 0;
  return run_fuzz(
      config, generator(), corpus, [](const RunProgress&) {}, [&] { return ++asked > questions; });
}

// A run at once, and the same run stopped and resumed again and again: the same bytes. At least `least_stops`.
inline void expect_resuming_changes_nothing(const TempFolder& folder, RunConfig config, int least_stops) {
  const Corpus whole = create(folder / "whole"), broken = create(folder / "broken");
  run(config, whole);
  config.resume = true;
  int stops = 0;
  while (run_until(100 + 60 * stops, config, broken).interrupted) ASSERT_LT(++stops, 200);
  EXPECT_GE(stops, least_stops);
  EXPECT_EQ(first_difference(tree_of(whole.folder()), tree_of(broken.folder())), "");
}

// A run as one and as `count` shards that are merged: the same bytes.
inline void expect_shards_make_one_run(const TempFolder& folder, RunConfig config, int count) {
  const Corpus whole = create(folder / "whole"), into = create(folder / "merged");
  run(config, whole);
  std::vector<Corpus> shards;
  for (int i = 0; i < count; ++i) {
    config.shard = {i, count};
    shards.push_back(create(folder / std::to_string(i)));
    EXPECT_TRUE(run(config, shards.back()).new_buckets.empty());
  }
  const Result<Merged> merged = merge(shards, into);
  ASSERT_TRUE(merged) << to_line(merged.issue());
  EXPECT_TRUE(merged->incomplete.empty() && merged->damaged.empty());
  EXPECT_EQ(first_difference(tree_of(whole.folder()), tree_of(into.folder())), "") << count;
}

}  // namespace contort::small_runs
