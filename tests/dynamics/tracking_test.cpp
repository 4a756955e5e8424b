// Tracking control: the cubic law, its stability, and the knots that it heads for.
#include "generator/dynamics/tracking.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "model/core/detmath.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

double drawn(int low, int high) { return *rc::gen::inRange(low * 1000, high * 1000 + 1) / 1000.0; }

// A body that is already on a cubic stays on it, for any cubic and any horizon.
RC_GTEST_PROP(Tracking, FollowsACubicExactly, ()) {
  const double a = drawn(-3, 3), b = drawn(-3, 3), c = drawn(-3, 3), d = drawn(-3, 3);
  const double end_s = drawn(1, 3) + 0.2;
  const auto value = [&](double t) { return a + t * (b + t * (c + t * d)); };
  const auto rate = [&](double t) { return b + t * (2 * c + t * 3 * d); };
  const double t = end_s * drawn(0, 1) * 0.9;
  const double acceleration = cubic_acceleration(value(t), rate(t), value(end_s), rate(end_s), end_s - t);
  RC_ASSERT(std::fabs(acceleration - (2 * c + 6 * d * t)) < 1e-9 * (1 + 1 / ((end_s - t) * (end_s - t))));
}

// Largest deviation from a resting target after many ticks with a fixed horizon.
double left_after(double horizon_in_ticks) {
  constexpr double kTick_s = 1.0 / 30;
  double q = 1.0, v = 0.0, most = 0.0;
  for (int i = 0; i < 400; ++i) {
    v += kTick_s * cubic_acceleration(q, v, 0.0, 0.0, horizon_in_ticks * kTick_s);
    q += kTick_s * v;
    if (!std::isfinite(q)) return 1e300;
    if (i > 350) most = std::max(most, std::fabs(q));
  }
  return most;
}

// 6 r^2 + 8 r = 4 at r = 0.387: 2.583 ticks.
TEST(Tracking, IsStableAboveItsBoundAndNotBelow) {
  for (const double ticks : {2.62, 2.7, 3.0, 4.0, 10.0}) EXPECT_LT(left_after(ticks), 1e-3) << ticks;
  for (const double ticks : {2.55, 2.4, 2.0, 1.0}) EXPECT_GT(left_after(ticks), 10.0) << ticks;
  for (const double tick_s : {1.0 / 30, 1.0 / 60, 1.0 / 240}) EXPECT_GE(shortest_horizon_s(tick_s), 3 * tick_s);
}

std::vector<double> sampled(int frames, double (*value)(double)) {
  std::vector<double> target;
  for (int f = 0; f <= frames; ++f) target.push_back(value(f / 30.0));
  return target;
}

TEST(Tracking, KnotsAreExtremaPlateausAndTheEnd) {
  const auto wave = sampled(90, [](double t) { return det::cos(kPi * t); });  // turns at 1 s and 2 s
  EXPECT_EQ(find_knots(wave, {0.2 * kRadPerDeg, 10.0}), (std::vector<int>{30, 60, 90}));
  const auto hold = sampled(90, [](double t) { return t < 1.0 ? 0.0 : t < 2.0 ? t - 1.0 : 1.0; });
  const std::vector<int> knots = find_knots(hold, {0.2 * kRadPerDeg, 10.0});
  EXPECT_EQ(knots, (std::vector<int>{30, 60, 90}));
}

TEST(Tracking, AWiggleIsNoExtremum) {
  const auto wave = sampled(90, [](double t) { return t + 0.1 * kRadPerDeg * det::sin(40.0 * t); });
  EXPECT_EQ(find_knots(wave, {0.5 * kRadPerDeg, 10.0}), (std::vector<int>{90}));
}

TEST(Tracking, KnotsAreAddedUntilTheCubicIsNearEnough) {
  const auto bent = sampled(90, [](double t) { return det::exp(t); });
  const std::vector<int> coarse = find_knots(bent, {0.2 * kRadPerDeg, 10.0});
  const std::vector<int> fine = find_knots(bent, {0.2 * kRadPerDeg, 0.1 * kRadPerDeg});
  EXPECT_EQ(coarse.size(), 1U);
  EXPECT_GT(fine.size(), 2U);
  EXPECT_LT(fine.size(), 12U);
}

TEST(Tracking, WithoutMotionThereAreOnlyEnds) {
  EXPECT_TRUE(find_knots(std::vector<double>{}).empty());
  EXPECT_TRUE(find_knots(std::vector<double>{1.0}).empty());
  EXPECT_EQ(find_knots(std::vector<double>(50, 2.0)), (std::vector<int>{49}));
}

// The seed's law on a squat's joint: a cosine between its extrema, with ticks of a frame and of a quarter.
TEST(Tracking, StaysNearACosine) {
  const auto target = sampled(90, [](double t) { return 0.75 * (1.0 - det::cos(kPi * t)); });
  const std::vector<int> knots = find_knots(target);
  for (const int ticks : {1, 4}) {
    const double tick_s = 1.0 / (30.0 * ticks);
    double q = target[0], v = 0.0, worst = 0.0;
    for (int i = 0; i < 80 * ticks; ++i) {
      const double frame = static_cast<double>(i) / ticks;
      worst = std::max(worst, std::fabs(q - 0.75 * (1.0 - det::cos(kPi * frame / 30.0))));
      const double ahead_s = horizon_s(knots, frame, 30.0, tick_s);
      const double then_s = frame / 30.0 + ahead_s;
      v += tick_s * cubic_acceleration(q, v, 0.75 * (1.0 - det::cos(kPi * then_s)), 0.75 * kPi * det::sin(kPi * then_s),
                                       ahead_s);
      q += tick_s * v;
    }
    std::printf("%d ticks a frame: %.2f deg off a cosine of 86 deg at worst\n", ticks, worst / kRadPerDeg);
    EXPECT_LT(worst, (ticks == 1 ? 5.0 : 2.0) * kRadPerDeg);
  }
}

TEST(Tracking, TheHorizonIsTheNextKnotWithinItsBounds) {
  const std::vector<int> knots = {30, 32, 120};
  const double tick_s = 1.0 / 120;
  EXPECT_NEAR(horizon_s(knots, 15.0, 30.0, tick_s), 0.5, 1e-12);
  EXPECT_NEAR(horizon_s(knots, 29.0, 30.0, tick_s), 0.1, 1e-12);  // not 0.033
  EXPECT_NEAR(horizon_s(knots, 30.0, 30.0, tick_s), 0.1, 1e-12);
  EXPECT_NEAR(horizon_s(knots, 40.0, 30.0, tick_s), kHold_s, 1e-12);  // the next one is 2.7 s away
  EXPECT_NEAR(horizon_s(knots, 120.0, 30.0, tick_s), kHold_s, 1e-12);
  EXPECT_EQ(merged_knots(knots, std::vector<int>{31, 32, 5}), (std::vector<int>{5, 30, 31, 32, 120}));
}

// About one axis a ball is a hinge.
RC_GTEST_PROP(Tracking, ABallAboutOneAxisIsAHinge, ()) {
  const Vec3 axis = unit_or(Vec3(drawn(-1, 1), drawn(-1, 1), drawn(-1, 1)), Vec3(0, 1, 0));
  const double from = drawn(-1, 1), to = drawn(-1, 1), v0 = drawn(-3, 3), v1 = drawn(-3, 3);
  const Quat base = axis_angle(Vec3(0.6, 0.0, 0.8), 0.7);
  const Vec3 ball =
      cubic_acceleration(base * axis_angle(axis, from), v0 * axis, base * axis_angle(axis, to), v1 * axis, 0.4);
  RC_ASSERT(length(ball - cubic_acceleration(from, v0, to, v1, 0.4) * axis) < 1e-9);
}

// A body on a cubic of its rotation vector stays on it; its acceleration comes from finite differences.
RC_GTEST_PROP(Tracking, ABallFollowsACubicOfItsRotationVector, ()) {
  const auto vec = [] { return Vec3(drawn(-1, 1), drawn(-1, 1), drawn(-1, 1)); };
  const Vec3 b = vec(), c = vec(), d = 0.5 * vec();
  const double end_s = 0.8;
  const auto turn = [&](double t) { return from_rotation_vector(t * (b + t * (c + t * d))); };
  const auto rate = [&](double t) {
    constexpr double kStep = 1e-5;
    return to_rotation_vector(glm::conjugate(turn(t - kStep)) * turn(t + kStep)) / (2 * kStep);
  };
  const Vec3 now = cubic_acceleration(turn(0.0), b, turn(end_s), rate(end_s), end_s);
  RC_ASSERT(length(now - 2.0 * c) < 1e-6);
}

}  // namespace
}  // namespace contort
