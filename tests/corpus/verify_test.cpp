// Replaying buckets: the result of all cases of a bucket, and the order of buckets.
#include "corpus/verify.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "corpus/bucket_files.h"
#include "tests/corpus/sample_corpus.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

class ReplayedBucket : public testing::Test {
 protected:
  ReplayedBucket() : corpus_(create(folder_)) {
    const Case min = elbow_case(190, 40), orig = elbow_case(200, 60);
    EXPECT_TRUE(corpus_.add({min, orig, "seed_1"}));
  }
  // Puts a case in place of another, under the name that it has.
  void replace(const std::string& file, const Case& by) {
    spill(corpus_.folder_of(only_bucket(corpus_)) + "/" + file, print_case(by));
  }
  BucketReplay replayed() {
    return replay_bucket(corpus_, only_bucket(corpus_), [&](const Case& c) { return run(c); });
  }
  Replay run(const Case& c) {
    ++runs_;
    return replay(c, evaluator_);
  }

  TempFolder folder_;
  Corpus corpus_;
  Evaluator evaluator_{stock_generator()};
  int runs_ = 0;
};

Case passing(Case c) {
  c.spec = bent_elbow(100);
  return c;
}

TEST_F(ReplayedBucket, AllCasesAreRun) {
  const BucketReplay ran = replayed();
  EXPECT_EQ(ran.shown, Shown::fails);
  EXPECT_EQ(ran.verdict, Verdict::same);
  EXPECT_EQ(ran.cases.size(), 3U);
  EXPECT_EQ(runs_, 3) << "what is the same bit by bit needs no second run";
}

TEST_F(ReplayedBucket, FailsWhileOneOfItsCasesDoes) {
  const Bucket bucket = only_bucket(corpus_);
  replace(bucket.min, passing(elbow_case()));
  replace(bucket.orig, passing(elbow_case()));
  EXPECT_EQ(replayed().shown, Shown::fails);
  EXPECT_EQ(replayed().verdict, Verdict::same) << "how it fails, not that some pass";
  replace(bucket.worst, passing(elbow_case()));
  EXPECT_EQ(replayed().shown, Shown::gone);
  EXPECT_EQ(replayed().verdict, Verdict::passes);
}

TEST_F(ReplayedBucket, IsGoneButDifferentWhereACaseFailsInAnotherWay) {
  const Bucket bucket = only_bucket(corpus_);
  for (const std::string& file : files_of(bucket)) replace(file, passing(elbow_case()));
  Case other = elbow_case();
  other.expect.check = "pop";
  replace(bucket.worst, other);
  EXPECT_EQ(replayed().shown, Shown::gone);
  EXPECT_EQ(replayed().verdict, Verdict::different);
}

TEST_F(ReplayedBucket, IsRefusedWhereACaseCannotBeReadAndNoneFails) {
  const Bucket bucket = only_bucket(corpus_);
  for (const std::string& file : files_of(bucket)) replace(file, passing(elbow_case()));
  spill(corpus_.folder_of(bucket) + "/" + bucket.orig, "{");
  EXPECT_EQ(replayed().shown, Shown::refused);
  std::filesystem::remove(corpus_.folder_of(bucket) + "/" + bucket.min);
  EXPECT_EQ(replayed().cases.front().result.issue.code, "file.unreadable");
}

TEST_F(ReplayedBucket, AFailureThatHasChangedButStaysIsNotFlaky) {
  Case changed = elbow_case();
  changed.expect.motion_hash = "0123456789abcdef";
  replace(only_bucket(corpus_).min, changed);
  EXPECT_EQ(replayed().shown, Shown::fails);
  EXPECT_EQ(replayed().verdict, Verdict::same_family);
}

TEST_F(ReplayedBucket, IsUnsteadyWhereASecondRunDiffersInAnyBit) {
  Case changed = elbow_case();
  changed.expect.motion_hash = "0123456789abcdef";
  replace(only_bucket(corpus_).min, changed);
  const BucketReplay ran = replay_bucket(corpus_, only_bucket(corpus_), [&](const Case& c) {
    Replay result = run(c);
    if (runs_ == 2) result.now.motion_hash = "fedcba9876543210";
    return result;
  });
  EXPECT_EQ(ran.shown, Shown::unsteady);
}

TEST_F(ReplayedBucket, AMarginThatIsNoNumberIsSteady) {
  Case changed = elbow_case();
  changed.expect.motion_hash = "0123456789abcdef";
  replace(only_bucket(corpus_).min, changed);
  const BucketReplay ran = replay_bucket(corpus_, only_bucket(corpus_), [&](const Case& c) {
    Replay result = run(c);
    result.now.worst_margin = std::numeric_limits<double>::quiet_NaN();
    return result;
  });
  EXPECT_EQ(ran.shown, Shown::fails);
}

TEST_F(ReplayedBucket, OnceItIsFlakyEachCaseRunsThreeTimes) {
  Bucket flaky = only_bucket(corpus_);
  flaky.state = BucketState::flaky;
  ASSERT_TRUE(write_bucket(corpus_.folder_of(flaky), flaky));
  EXPECT_EQ(replayed().shown, Shown::fails);
  EXPECT_EQ(runs_, 9);
}

// ---- order

std::vector<Bucket> one_of_each_state() {
  std::vector<Bucket> all;
  for (int s = static_cast<int>(BucketState::invalid); s >= 0; --s)
    for (const char* id : {"b", "a"}) {
      Bucket bucket;
      bucket.id = id + std::to_string(s);
      bucket.check = "pop";
      bucket.state = static_cast<BucketState>(s);
      all.push_back(bucket);
    }
  return all;
}

TEST(ReplayOrder, RegressedFirstThenNewThenOpenAndFixedLast) {
  const std::vector<Bucket> ordered = replay_order(one_of_each_state());
  std::vector<BucketState> states;
  for (const Bucket& bucket : ordered)
    if (states.empty() || states.back() != bucket.state) states.push_back(bucket.state);
  using enum BucketState;
  EXPECT_EQ(states, (std::vector{regressed, fresh, quarantined, open, flaky, invalid, fixed}));
  for (std::size_t i = 0; i < ordered.size(); i += 2) EXPECT_LT(ordered[i].id, ordered[i + 1].id);
}

TEST(ReplayOrder, AnotherDayIsAnotherOrderAndLosesNone) {
  std::vector<Bucket> many(40);
  for (std::size_t i = 0; i < many.size(); ++i) many[i].id = std::to_string(100 + i);
  const std::vector<Bucket> monday = replay_order_of_day(many, "2027-02-08"),
                            tuesday = replay_order_of_day(many, "2027-02-09");
  EXPECT_NE(monday, tuesday);
  EXPECT_EQ(monday, replay_order_of_day(many, "2027-02-08"));
  EXPECT_TRUE(std::ranges::is_permutation(monday, many));
}

TEST(ReplayOrder, NoStateWaitsForAllOfAnother) {
  std::vector<Bucket> buckets(90);
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    buckets[i].id = std::to_string(100 + i);
    buckets[i].state = i < 4 ? BucketState::fixed : i < 8 ? BucketState::open : BucketState::fresh;
  }
  const std::vector<Bucket> ordered = replay_order_of_day(buckets, "2027-02-08");
  EXPECT_TRUE(std::ranges::is_permutation(ordered, buckets));
  const auto among_the_first_six = [&](BucketState state) {
    return std::ranges::count(ordered.begin(), ordered.begin() + 6, state, &Bucket::state);
  };
  for (const BucketState state : {BucketState::fresh, BucketState::open, BucketState::fixed})
    EXPECT_EQ(among_the_first_six(state), 2) << state_name(state);
}

TEST(ReplayOrder, OnlyQuarantinedOnesAreNeverSkipped) {
  for (const Bucket& bucket : one_of_each_state())
    EXPECT_EQ(may_skip(bucket), bucket.state != BucketState::quarantined) << state_name(bucket.state);
}

}  // namespace

}  // namespace contort
