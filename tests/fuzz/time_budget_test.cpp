// The division of a run's time.
#include "fuzz/time_budget.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

TEST(TimeBudgets, WithoutALimitAreNeverOver) {
  TimeBudget time(0.0, 100.0);
  time.begin_round(200.0);
  EXPECT_EQ(time.deadline_s(), 0.0);
  EXPECT_FALSE(time.is_over(1e9) || time.must_fold(1e9));
  EXPECT_TRUE(time.has_time_for_waiting(1e9));
  EXPECT_EQ(time.elapsed_s(130.0), 30.0);
}

TEST(TimeBudgets, GiveHalfOfWhatIsLeftToWhatARoundFinds) {
  TimeBudget time(60.0, 100.0);
  EXPECT_EQ(time.deadline_s(), 160.0);
  EXPECT_FALSE(time.is_over(159.0));
  EXPECT_TRUE(time.is_over(160.0));
  EXPECT_TRUE(time.has_time_for_waiting(129.0));
  EXPECT_FALSE(time.has_time_for_waiting(130.0));
  time.begin_round(140.0);
  EXPECT_FALSE(time.must_fold(149.0));
  EXPECT_TRUE(time.must_fold(150.0));
}

TEST(KeepingPaces, KeepEverySecondAndFiftyTimesAsRarelyAsItTakes) {
  KeepingPace pace(100.0);
  EXPECT_FALSE(pace.is_due(100.5));
  EXPECT_TRUE(pace.is_due(101.0));
  pace.kept(101.0, 101.001);
  EXPECT_FALSE(pace.is_due(102.0));
  EXPECT_TRUE(pace.is_due(102.001));
  pace.kept(103.0, 103.5);
  EXPECT_FALSE(pace.is_due(128.4));
  EXPECT_TRUE(pace.is_due(128.5));
}

}  // namespace
}  // namespace contort
