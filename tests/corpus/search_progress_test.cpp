#include "corpus/search_progress.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace contort {
namespace {

RunRecord run(const std::string& name, std::int64_t cases) {
  RunRecord record;
  record.name = name, record.cases = cases, record.failing = 3;
  record.arms["uniform"] = {cases / 2, 1}, record.arms["guided"] = {cases / 2, 2};
  return record;
}

Family named(const std::string& subject) { return {"pop", "human", subject}; }

TEST(SearchProgress, FamiliesAreDiscoveredOnceWhereTheyWereMetFirst) {
  RunRecord first = run("a", 100), second = run("b", 50);
  first.families = {{named("x"), {1, 7, {7}, "uniform"}}, {named("y"), {5, 20, {20, 30}, "guided"}}};
  second.families = {{named("x"), {1, 0, {0}, "guided"}}, {named("z"), {1, 9, {9}, "guided"}}};
  const SearchProgress all = progress_of(std::vector{first, second});
  EXPECT_EQ(all.cases, 150);
  EXPECT_EQ(all.failing, 6);
  EXPECT_EQ(all.discovered, (std::vector<std::int64_t>{8, 21, 110}));
  EXPECT_EQ(all.met_once, 1) << "x was met twice, y five times";
  EXPECT_EQ(all.arms, (std::vector<ArmProgress>{{"guided", 75, 4, 2}, {"uniform", 75, 2, 1}}));
  EXPECT_DOUBLE_EQ(unseen_share(all), 1.0 / 150);
}

// Three families that one case alone showed are one surprise, not three.
TEST(SearchProgress, ACaseThatShowsSeveralFamiliesCountsOnce) {
  RunRecord one = run("a", 100);
  one.families = {{named("x"), {1, 7, {7}, "uniform"}}, {named("y"), {1, 7, {7}, "uniform"}},
                  {named("z"), {1, 7, {7}, "uniform"}},
                  {named("w"), {1, 8, {8}, "of an older version"}}, {named("v"), {9, 7, {7, 8}, "uniform"}}};
  const SearchProgress all = progress_of(std::vector{one});
  EXPECT_EQ(all.met_once, 4);
  EXPECT_EQ(all.lone_cases, 2);
  EXPECT_DOUBLE_EQ(unseen_share(all), 0.02);
  EXPECT_EQ(all.arms.size(), 2u) << "no row for a way that drew nothing";
  RunRecord other = run("b", 100);
  other.families = {{named("u"), {1, 7, {7}, "uniform"}}};
  EXPECT_EQ(progress_of(std::vector{one, other}).lone_cases, 3) << "another run's case 7 is another case";
}

TEST(SearchProgress, ShardsOfOneRunCountAsOne) {
  std::vector<RunRecord> shards;
  for (int k = 0; k < 4; ++k) {
    RunRecord shard = run("a", 25);
    shard.shard = k, shard.shards = 4;
    shard.families = {{named("x"), {1, 40 + k, {40 + k}, "uniform"}}};
    shards.push_back(shard);
  }
  const SearchProgress whole = progress_of(shards);
  EXPECT_EQ(whole.cases, 100);
  EXPECT_EQ(whole.discovered, (std::vector<std::int64_t>{41}));
  std::ranges::reverse(shards);
  EXPECT_EQ(progress_of(shards), whole);
  EXPECT_EQ(progress_of(std::vector{shards[1]}).discovered, (std::vector<std::int64_t>{11})) << "a quarter of them ran";
}

// 3 of 300: with a true fraction of 1 %, 300 cases without a failure have a probability of 4.9 %.
TEST(SearchProgress, WhereNothingFailedThereIsABound) {
  EXPECT_DOUBLE_EQ(unseen_share(progress_of(std::vector{run("a", 300)})), 0.01);
  EXPECT_DOUBLE_EQ(unseen_share(progress_of({})), 1.0);
  EXPECT_DOUBLE_EQ(unseen_share(progress_of(std::vector{run("a", 2)})), 1.0);
}

}  // namespace
}  // namespace contort
