// The search's memory: which cases it keeps, drops, and chooses as ancestors.
#include "fuzz/islands.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fuzz/compose.h"
#include "tests/checks/family_text.h"
#include "tests/checks/small_character.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

const Odds kAlwaysGuided{1, 1.0, 0.0};
constexpr std::int64_t kLate = 1'000'000;  // where guidance has its whole share

// A subject of the group that island 0 is guided by.
Family own_subject(int which) {
  for (int i = 0;; ++i) {
    const Family name{"joint_range", "human", "subject " + std::to_string(i)};
    if (group_of_target(name) == 0 && which-- == 0) return name;
  }
}

Family named(const std::string& subject) { return {"joint_range", "human", subject}; }

void show(Island& island, std::int64_t index, const Family& family, double margin) {
  island.learn({index}, {{family, margin}}, {});
}

TEST(Islands, EveryGroupGuidesAsManyIslands) {
  std::array<int, kTargetGroups> islands{};
  for (std::int64_t index = 0; index < kRound; index += kGeneration) ++islands[static_cast<std::size_t>(group_of(index))];
  for (const int count : islands) EXPECT_EQ(count, kIslands / kTargetGroups);
}

TEST(Islands, KeepTheCasesThatCameNearest) {
  Island island;
  const double margins[] = {5.0, 2.0, 4.0, 1.0, 3.0, 1.0};
  for (std::size_t i = 0; i < std::size(margins); ++i)
    show(island, static_cast<std::int64_t>(i), named("a"), margins[i]);
  const TargetPool& pool = island.pools.at(named("a"));
  EXPECT_EQ(pool.nearest, (std::vector<PoolEntry>{{1.0, {3}}, {2.0, {1}}, {3.0, {4}}}));
  EXPECT_EQ(pool.farthest, 5.0);
  EXPECT_EQ(pool.relative_distance(), 1.0 / 4.0);
}

TEST(Islands, LetGoOfWhatIsBroken) {
  Island island;
  const Family own = own_subject(0);
  show(island, 0, own, 1.0);
  island.learn({1}, {}, {own});
  EXPECT_TRUE(island.pools.empty());
  show(island, 2, own, 0.5);
  EXPECT_TRUE(island.pools.empty()) << "nothing is left to be found near it";
}

TEST(Islands, DoNotFollowASubjectThatNothingMoves) {
  Island island;
  for (std::int64_t i = 0; i < 9; ++i) show(island, i, named("flat"), 0.01);
  EXPECT_EQ(island.lineage_of(kAlwaysGuided, kLate), Lineage{kLate});
  show(island, 20, named("moves"), 9.0);
  show(island, 21, named("moves"), 3.0);
  for (std::int64_t index = kLate; index < kLate + 50; ++index) {
    const Lineage lineage = island.lineage_of(kAlwaysGuided, index);
    ASSERT_EQ(lineage.size(), 2U);
    EXPECT_GE(lineage.front(), 20);
  }
}

TEST(Islands, FollowThePromisingMoreOftenAndTheRestToo) {
  Island island;
  for (int subject = 0; subject < 8; ++subject) {  // each subject has a nearest margin of its own
    show(island, 10 * subject, own_subject(subject), 10.0);
    show(island, 10 * subject + 1, own_subject(subject), 0.5 + subject);
  }
  std::array<int, 8> chosen{};
  for (std::int64_t index = kLate; index < kLate + 1000; ++index)
    ++chosen[static_cast<std::size_t>(island.lineage_of(kAlwaysGuided, index).front() / 10)];
  EXPECT_GT(chosen[0], 300);  // 1 - (7/8)^4 = 0.41
  EXPECT_GT(chosen[0], 2 * chosen[3]);
  EXPECT_GT(chosen[5], 0);
}

TEST(Lineages, GuidanceComesIntoItsShareLittleByLittle) {
  const Odds odds{1, 0.5, 0.3};
  const auto guided_from = [&](std::int64_t first) {
    int guided = 0;
    for (std::int64_t index = first; index < first + 1000; ++index) guided += wants_guidance(odds, index);
    return guided;
  };
  EXPECT_LT(guided_from(0), 100);
  EXPECT_NEAR(guided_from(100'000), 500, 60);
  EXPECT_LT(guided_from(1000), guided_from(3000));
}

// A case has more than 400 numbers, and most have no effect in it.
TEST(Lineages, AMutationChangesTheSpec) {
  DrawConfig config{{"human"}};
  config.profile.staged = false;
  int same = 0;
  for (std::int64_t index = 0; index < 200; ++index) {
    const auto spec_of = [&](const Lineage& line) {
      return compose(raw_of(config, stock_generator(), 5, line), config, stock_generator());
    };
    same += spec_of({index}) == spec_of({index, 1000 + index});
  }
  EXPECT_LE(same, 2);
}

TEST(Lineages, AnInterruptMayComeAtAnotherTime) {
  DrawConfig config{{"human"}};
  config.profile.staged = false;
  config.profile.uniform = 1.0;  // even draws, so that many parents have one interrupt
  int moved = 0;
  for (std::int64_t index = 0; index < 400 && moved < 3; ++index) {
    const auto spec_of = [&](const Lineage& line) {
      return compose(raw_of(config, stock_generator(), 5, line), config, stock_generator());
    };
    const Spec parent = spec_of({index});
    if (parent.interrupts.size() != 1) continue;
    for (std::int64_t child = 0; child < 20; ++child) {
      Spec other = spec_of({index, 10'000 + 20 * index + child});
      if (other.interrupts.size() != 1 || other.interrupts[0].when.frame == parent.interrupts[0].when.frame) continue;
      other.interrupts[0].when.frame = parent.interrupts[0].when.frame;
      moved += other == parent;
    }
  }
  EXPECT_GE(moved, 3) << "and nothing else changes";
}

}  // namespace

}  // namespace contort
