// Lone steps, and steps that look like intended style.
#include "checks/lone_steps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace contort {
namespace {

constexpr LoneLimits kTestLimits{1.0, 4.0};

// The intervals, by number, of keys at these places that are more than allowed.
std::vector<std::size_t> lone(const std::vector<double>& places, double rate_hz = 30.0,
                              const LoneLimits& limits = kTestLimits) {
  const auto apart = [&](std::size_t a, std::size_t b) { return std::fabs(places[b] - places[a]); };
  std::vector<SpeedInterval> steps;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double t0 = static_cast<double>(i) / rate_hz, t1 = static_cast<double>(i + 1) / rate_hz;
    steps.push_back({t0, t1, apart(i, i + 1) / (t1 - t0)});
  }
  const std::vector<double> allowed = allowed_lone_steps(steps, apart, limits);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (apart(i, i + 1) > allowed[i]) out.push_back(i);
  return out;
}

using Intervals = std::vector<std::size_t>;

TEST(LoneSteps, AKeyThatIsOffIsTwo) {
  EXPECT_EQ(lone({0, 0, 0, 0, 2, 0, 0, 0, 0}), (Intervals{3, 4}));
  EXPECT_EQ(lone({0, 0, 0, 0, 2, 2.1, 0, 0, 0, 0}), (Intervals{3, 5})) << "two keys";
  EXPECT_EQ(lone({0, 0, 0, 0, 0.9, 0, 0, 0, 0}), Intervals{}) << "too small to be seen";
}

TEST(LoneSteps, AJumpThatStaysIsOne) {
  EXPECT_EQ(lone({0, 0.1, 0.2, 0.3, 5, 5.1, 5.2, 5.3}), (Intervals{3}));
  EXPECT_EQ(lone({0, 0, 0, 0, 3, 3, 3, 3}), Intervals{}) << "below the limit of jumps";
  EXPECT_EQ(lone({0, 0, 0, 1.5, 6.5, 8, 8, 8, 8}), Intervals{}) << "it gets fast before, and slow after";
  EXPECT_EQ(lone({0, 0, 0, 1, 6.5, 7.5, 7.6, 7.7}), (Intervals{3})) << "a quarter of the step is no run-up";
}

TEST(LoneSteps, MotionThatComesAgainIsStyle) {
  EXPECT_EQ(lone({0, 0, 0, 5, 5, 5, 0, 0, 0, 5, 5, 5}), Intervals{}) << "a run";
  EXPECT_EQ(lone({0, 2, 0, 2, 0, 2, 0, 2}), Intervals{}) << "shaking is for jitter";
}

TEST(LoneSteps, NeedMotionAroundThemAndShortIntervals) {
  EXPECT_EQ(lone({0, 5, 0}), Intervals{});
  EXPECT_EQ(lone({0, 0, 0, 0, 5, 0, 0, 0, 0}, 8.0), Intervals{}) << "keys that far apart were set by a person";
}

TEST(LoneSteps, AStepInterpolationIsJudgedByBlipsOnly) {
  const LoneLimits limits = lone_limits(Interpolation::step, kTestLimits);
  EXPECT_EQ(lone({0, 0, 0, 0, 5, 5, 5, 5}, 30.0, limits), Intervals{});
  EXPECT_EQ(lone({0, 0, 0, 0, 5, 0, 0, 0}, 30.0, limits), (Intervals{3, 4}));
}

}  // namespace
}  // namespace contort
