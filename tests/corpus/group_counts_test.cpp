#include "corpus/group_counts.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "corpus/baseline.h"

namespace contort {
namespace {

const Family kPop{"pop", "human", "head/neck"};
const Family kCrash{"crash", "human", "SIGSEGV"};

GroupCounts seen(std::int64_t groups, const Family& family, std::int64_t with) {
  return {groups, {{family, with}}};
}

TEST(GroupCounts, AddUpRunsExceptThoseOfTheBaseline) {
  RunRecord first, second;
  first.name = "seed_1", first.groups = 10, first.families[kPop].groups = 3;
  second.name = "seed_2", second.groups = 5, second.families[kPop].groups = 1;
  const std::vector<RunRecord> runs = {first, second};
  EXPECT_EQ(group_counts_of(runs), seen(15, kPop, 4));
  EXPECT_EQ(group_counts_of(runs, {"seed_1"}), seen(5, kPop, 1));
  GroupCounts sum = seen(10, kPop, 3);
  add(seen(5, kPop, 1), sum);
  EXPECT_EQ(sum, group_counts_of(runs));
}

// Sums of binomial terms, by hand: of 3 sightings at least 2 with chance 1/2, and so on.
TEST(GroupCounts, KnowTheBinomialTail) {
  EXPECT_DOUBLE_EQ(chance_of_as_many(2, 1, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(chance_of_as_many(10, 0, 0.5), 1.0 / 1024.0);
  EXPECT_NEAR(chance_of_as_many(4, 2, 0.25), 15 * 9.0 / 4096 + 6 * 3.0 / 4096 + 1.0 / 4096, 1e-15);
  EXPECT_NEAR(chance_of_as_many(0, 5, 0.3), 1.0, 1e-12);
}

// Twice as many as expected, with thousands of sightings: single factors would exceed the range of doubles.
TEST(GroupCounts, KnowTheTailOfManySightings) {
  EXPECT_GT(chance_of_as_many(50'500, 49'500, 0.5), 7e-4);
  EXPECT_LT(chance_of_as_many(50'500, 49'500, 0.5), 9e-4);
  EXPECT_LT(chance_of_as_many(20'000, 10'000, 0.5), 1e-12);
}

TEST(GroupCounts, AskForTenGroupsOfAFamilyThatAnEquallyLongRunNeverShowed) {
  const GroupCounts none{250, {}};
  EXPECT_FALSE(is_more_frequent(kPop, seen(250, kPop, 9), none));
  EXPECT_TRUE(is_more_frequent(kPop, seen(250, kPop, 10), none));
  EXPECT_TRUE(is_more_frequent(kPop, seen(25, kPop, 4), none)) << "a long baseline makes few sightings telling";
  EXPECT_FALSE(is_more_frequent(kPop, seen(250, kPop, 60), {2, {}})) << "a short one makes many say little";
  EXPECT_FALSE(is_more_frequent(kPop, seen(250, kPop, 200), {})) << "nothing was counted";
}

RC_GTEST_PROP(GroupCounts, FewerSightingsAreNeverMoreTelling, ()) {
  const auto groups = *rc::gen::inRange<std::int64_t>(1, 500), before = *rc::gen::inRange<std::int64_t>(1, 500);
  const auto of_now = *rc::gen::inRange<std::int64_t>(1, groups + 1);
  const auto of_before = *rc::gen::inRange<std::int64_t>(0, before + 1);
  const GroupCounts baseline = seen(before, kPop, of_before);
  if (!is_more_frequent(kPop, seen(groups, kPop, of_now), baseline))
    RC_ASSERT(!is_more_frequent(kPop, seen(groups, kPop, of_now - 1), baseline));
  RC_ASSERT(!is_more_frequent(kPop, seen(groups, kPop, of_now), seen(groups, kPop, of_now)));
}

Baseline counted(const GroupCounts& groups) {
  Baseline known;
  known.seen = groups;
  return known;
}

TEST(GroupCounts, DecideWhetherANewBucketGates) {
  Bucket bucket;
  bucket.family = kPop, bucket.id = "0123456789ab";
  const Baseline known = counted(seen(250, kPop, 20));
  EXPECT_FALSE(is_gating(bucket, "2026-11-29", known, seen(250, kPop, 30)));
  EXPECT_TRUE(is_gating(bucket, "2026-11-29", known, seen(250, kPop, 90)));
  EXPECT_TRUE(is_gating(bucket, "2026-11-29", known, {})) << "a replay counts nothing";
  EXPECT_TRUE(is_gating(bucket, "2026-11-29", {}, seen(250, kPop, 1))) << "nor does an empty baseline";
  bucket.state = BucketState::regressed;
  EXPECT_TRUE(is_gating(bucket, "2026-11-29", known, seen(250, kPop, 1))) << "what was fixed must stay so";
}

TEST(GroupCounts, LetOneCrashGateThatTheBaselineNeverSaw) {
  Bucket bucket;
  bucket.family = kCrash;
  EXPECT_TRUE(is_gating(bucket, "2026-11-29", counted({250, {}}), seen(250, kCrash, 1)));
  EXPECT_FALSE(is_gating(bucket, "2026-11-29", counted(seen(250, kCrash, 2)), seen(250, kCrash, 1)));
}

CauseRow row_with(const std::string& id, const Family& family) {
  CauseRow row{.id = id};
  row.members.push_back({});
  row.members.back().bucket.family = family;
  return row;
}

TEST(GroupCounts, SayWhichCausesAreNews) {
  Baseline known = counted(seen(250, kPop, 20));
  known.causes = {"a"};
  const auto news = [&](const std::string& id, const Family& family, const GroupCounts& now) {
    std::vector<CauseRow> rows = {row_with(id, family)};
    mark_news(rows, known, now);
    return rows.front().news;
  };
  const Family knee{"pop", "human", "leg_left/knee"};
  EXPECT_EQ(news("a", kPop, seen(250, kPop, 20)), CauseNews::known);
  EXPECT_EQ(news("a", kPop, seen(250, kPop, 200)), CauseNews::more);
  EXPECT_EQ(news("b", kPop, seen(250, kPop, 20)), CauseNews::known) << "the family is as frequent as it was";
  EXPECT_EQ(news("b", kPop, seen(250, kPop, 200)), CauseNews::fresh);
  EXPECT_EQ(news("b", knee, seen(250, knee, 2)), CauseNews::rare);
  EXPECT_EQ(news("b", knee, seen(250, knee, 40)), CauseNews::fresh);
}

TEST(GroupCounts, PutNewsFirst) {
  Baseline known = counted(seen(250, kPop, 20));
  known.causes = {"a"};
  std::vector<CauseRow> rows = {row_with("a", kPop), row_with("b", kCrash)};
  mark_news(rows, known, seen(250, kPop, 20));
  EXPECT_EQ(rows.front().id, "b");
  EXPECT_EQ(rows.back().id, "a");
}

}  // namespace
}  // namespace contort
