// The bounds that detmath.h states, against long double (64 bits of mantissa: its own error is 1000 times smaller).
#include "model/core/detmath.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace contort {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kQuietNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();
constexpr long double kPiLong = 3.14159265358979323846264338327950288L;

double error(double got, long double truth) { return static_cast<double>(std::fabs(got - truth)); }

// Doubles next to x, and x.
std::vector<double> around(double x) {
  std::vector<double> values = {x};
  double up = x;
  double down = x;
  for (int i = 0; i < 4; ++i) {
    values.push_back(up = std::nextafter(up, kInf));
    values.push_back(down = std::nextafter(down, -kInf));
  }
  return values;
}

void append(std::vector<double>& into, const std::vector<double>& more) {
  into.insert(into.end(), more.begin(), more.end());
}

std::vector<double> random_in(double low, double high, int count) {
  std::mt19937_64 engine(20260101);
  std::uniform_real_distribution<double> number(low, high);
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(number(engine));
  return values;
}

// Both signs of magnitudes from the smallest subnormal to `largest`.
std::vector<double> magnitudes(double largest) {
  std::vector<double> values;
  for (double x = kTiny; x <= largest; x *= 1.37) {
    values.push_back(x);
    values.push_back(-x);
    if (x < 4 * kTiny) x = std::nextafter(x, kInf);  // x * 1.37 may round back to x
  }
  return values;
}

std::vector<double> angles() {
  std::vector<double> values = random_in(-1e4, 1e4, 200000);
  append(values, random_in(-7.0, 7.0, 200000));
  append(values, magnitudes(1e4));
  for (int k = -6367; k <= 6367; ++k)
    append(values, around(static_cast<double>(static_cast<long double>(k) * kPiLong / 2)));
  for (int i = -10000; i <= 10000; ++i) values.push_back(i / 1000.0);
  append(values, {1e4, -1e4, 0.0, -0.0});
  return values;
}

std::vector<double> units() {
  std::vector<double> values = random_in(-1.0, 1.0, 200000);
  append(values, magnitudes(1.0));
  for (const double x : magnitudes(1e-3))
    if (x > 0) append(values, {1.0 - x, x - 1.0});
  append(values, {-1.0, 1.0, 0.0, -0.0, 0.5, -0.5});
  return values;
}

// Worst measured: 1.21e-16.
TEST(Detmath, SinAndCosAreWithinTheirBound) {
  double worst = 0.0;
  for (const double x : angles()) {
    const det::SinCos both = det::sincos(x);
    worst = std::max({worst, error(both.sin, sinl(x)), error(both.cos, cosl(x))});
  }
  EXPECT_LE(worst, 5e-16);
  RecordProperty("worst", std::to_string(worst * 1e16));
}

TEST(Detmath, SinAndCosAreTheirOwnFunctions) {
  for (const double x : random_in(-100.0, 100.0, 1000)) {
    EXPECT_EQ(det::sin(x), det::sincos(x).sin);
    EXPECT_EQ(det::cos(x), det::sincos(x).cos);
  }
}

TEST(Detmath, SinOfTheSmallestNumbersIsTheNumber) {
  for (const double x : {kTiny, -kTiny, 1e-310, -1e-200, 1e-9}) EXPECT_EQ(det::sin(x), x);
  EXPECT_EQ(det::cos(kTiny), 1.0);
}

TEST(Detmath, AnglesTooLargeToMeanAnythingAreNaN) {
  EXPECT_FALSE(std::isnan(det::sin(1e9)));
  EXPECT_FALSE(std::isnan(det::cos(-1e9)));
  for (const double x : {std::nextafter(1e9, kInf), -1.1e9, 1e300, kInf, -kInf, kQuietNaN}) {
    EXPECT_TRUE(std::isnan(det::sin(x))) << x;
    EXPECT_TRUE(std::isnan(det::cos(x))) << x;
  }
}

// Angles that test the range reduction: near multiples of pi/4, very large, and NaN, in rows of any length.
TEST(Detmath, ManyAtATimeAreTheSameBits) {
  std::vector<double> angles = {0.0,
                                -0.0,
                                1e9,
                                -1e9,
                                1.1e9,
                                -1e300,
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN(),
                                5e-324,
                                0.5,
                                1e-9};
  for (int k = -200; k <= 200; ++k) {
    const double x = k * 0.25 * std::numbers::pi;
    for (const double near : {x, std::nextafter(x, 1e9), std::nextafter(x, -1e9), 1e5 * x, x + 0.1})
      angles.push_back(near);
  }
  const auto bits = [](const det::SinCos& v) {
    return std::pair(std::bit_cast<std::uint64_t>(v.sin), std::bit_cast<std::uint64_t>(v.cos));
  };
  // All values from the ninth on are angles; rows with other values are computed one by one.
  for (const std::size_t first : std::initializer_list<std::size_t>{0, 1, 2, 8, 9, 10})
    for (const std::size_t count : std::initializer_list<std::size_t>{0, 1, 2, 3, 4, 6, 7, angles.size() - first}) {
      const std::span<const double> row = std::span(angles).subspan(first, count);
      std::vector<det::SinCos> all(count);
      det::sincos(row, all);
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(bits(all[i]), bits(det::sincos(row[i]))) << row[i];
    }
}

RC_GTEST_PROP(Detmath, SinIsOddAndCosIsEven, ()) {
  const double x = *rc::gen::inRange(-10000000, 10000001) / 1e3;
  RC_ASSERT(std::fabs(det::sin(-x) + det::sin(x)) <= 5e-16);
  RC_ASSERT(std::fabs(det::cos(-x) - det::cos(x)) <= 5e-16);
}

RC_GTEST_PROP(Detmath, QuadrantsFollowFromEachOther, ()) {
  const double x = *rc::gen::inRange(-6000, 6001) / 1e3;
  const det::SinCos here = det::sincos(x);
  const det::SinCos next = det::sincos(x + static_cast<double>(kPiLong / 2));
  RC_ASSERT(std::fabs(here.sin * here.sin + here.cos * here.cos - 1.0) <= 1e-15);
  RC_ASSERT(std::fabs(next.sin - here.cos) <= 2e-15);  // x + pi/2 is rounded to 9e-16
  RC_ASSERT(std::fabs(next.cos + here.sin) <= 2e-15);
}

// Worst measured: 4.75e-16, at angles near pi, where half a unit in the last place is 2.2e-16.
TEST(Detmath, Atan2IsWithinItsBoundInAllDirections) {
  double worst = 0.0;
  const std::vector<double> a = random_in(-2.0, 2.0, 100000);
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    worst = std::max(worst, error(det::atan2(a[i], a[i + 1]), atan2l(a[i], a[i + 1])));
  for (const double y : magnitudes(1e300))
    for (const double x : {1.0, -1.0, 1e-300, -1e-300, kTiny, -kTiny, 1e300, y, -y})
      worst = std::max(worst, error(det::atan2(y, x), atan2l(y, x)));
  EXPECT_LE(worst, 5e-16);
  RecordProperty("worst", std::to_string(worst * 1e16));
}

TEST(Detmath, Atan2KnowsAxesAndInfinities) {
  const double pi = static_cast<double>(kPiLong);
  EXPECT_EQ(det::atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(det::atan2(0.0, 1.0), 0.0);
  EXPECT_EQ(det::atan2(1.0, 0.0), pi / 2);
  EXPECT_EQ(det::atan2(-1.0, 0.0), -pi / 2);
  EXPECT_EQ(det::atan2(0.0, -1.0), pi);
  EXPECT_EQ(det::atan2(kInf, 1.0), pi / 2);
  EXPECT_EQ(det::atan2(1.0, kInf), 0.0);
  EXPECT_EQ(det::atan2(kInf, kInf), pi / 4);
  EXPECT_EQ(det::atan2(-kInf, kInf), -pi / 4);
  EXPECT_NEAR(det::atan2(kInf, -kInf), 3 * pi / 4, 5e-16);
  EXPECT_EQ(det::atan2(1.0, -kInf), pi);
  EXPECT_TRUE(std::isnan(det::atan2(kQuietNaN, 1.0)));
  EXPECT_TRUE(std::isnan(det::atan2(1.0, kQuietNaN)));
}

// Worst measured: 6.34e-16.
TEST(Detmath, AcosAndAsinAreWithinTheirBound) {
  double worst = 0.0;
  for (const double x : units())
    worst = std::max({worst, error(det::acos(x), acosl(x)), error(det::asin(x), asinl(x))});
  EXPECT_LE(worst, 1e-15);
  RecordProperty("worst", std::to_string(worst * 1e16));
}

TEST(Detmath, ArgumentsBeyondOneAreClampedAndNaNStays) {
  for (const double x : {std::nextafter(1.0, 2.0), 2.0, kInf}) {
    EXPECT_EQ(det::acos(x), 0.0);
    EXPECT_EQ(det::acos(-x), static_cast<double>(kPiLong));
    EXPECT_EQ(det::asin(x), static_cast<double>(kPiLong / 2));
    EXPECT_EQ(det::asin(-x), -static_cast<double>(kPiLong / 2));
  }
  EXPECT_TRUE(std::isnan(det::acos(kQuietNaN)));
  EXPECT_TRUE(std::isnan(det::asin(kQuietNaN)));
}

// Worst measured: 1.51e-16.
TEST(Detmath, ExpIsWithinItsRelativeBound) {
  double worst = 0.0;
  std::vector<double> values = random_in(-700.0, 700.0, 200000);
  append(values, random_in(-2.0, 2.0, 100000));
  append(values, magnitudes(700.0));
  for (const double x : values) worst = std::max(worst, static_cast<double>(std::fabs(det::exp(x) / expl(x) - 1.0L)));
  EXPECT_LE(worst, 5e-16);
  RecordProperty("worst", std::to_string(worst * 1e16));
}

TEST(Detmath, ExpEndsInInfinityAndInZero) {
  EXPECT_EQ(det::exp(0.0), 1.0);
  EXPECT_TRUE(std::isfinite(det::exp(709.78)));
  EXPECT_EQ(det::exp(709.79), kInf);
  EXPECT_EQ(det::exp(kInf), kInf);
  EXPECT_EQ(det::exp(-746.0), 0.0);
  EXPECT_EQ(det::exp(-kInf), 0.0);
  EXPECT_EQ(det::exp(-744.0), static_cast<double>(expl(-744.0L)));  // 2 units of the subnormals
  EXPECT_TRUE(std::isnan(det::exp(kQuietNaN)));
}

// Compares bits, to find another constant, another order of operations or a fused multiply-add. A change of them
// changes every golden hash and must be in the changelog.
TEST(Detmath, BitsAreTheSameEverywhere) {
  struct Spot {
    const char* what;
    double value;
    std::uint64_t bits;
  };
  const Spot spots[] = {
      {"sin 1", det::sin(1.0), 0x3feaed548f090cee},          {"sin -2.5", det::sin(-2.5), 0xbfe326af0dcfcab0},
      {"sin 9999.9", det::sin(9999.9), 0xbfcac18451da8afb},  {"cos 0.7", det::cos(0.7), 0x3fe87996529f9d93},
      {"cos 4", det::cos(4.0), 0xbfe4eaa606db24c1},          {"cos -1234.5", det::cos(-1234.5), 0xbfefa8f2ceb78372},
      {"atan2 1 3", det::atan2(1, 3), 0x3fd4978fa3269ee1},   {"atan2 5 -2", det::atan2(5, -2), 0x3fff38892f1e0c89},
      {"atan2 -2 7", det::atan2(-2, 7), 0xbfd1cfa95f7a8dce}, {"acos 0.1", det::acos(0.1), 0x3ff787b22ce3f590},
      {"acos -0.99", det::acos(-0.99), 0x4008001be1bc011b},  {"asin 0.3", det::asin(0.3), 0x3fd380159e14f6ff},
      {"exp 1", det::exp(1.0), 0x4005bf0a8b14576a},          {"exp -17.3", det::exp(-17.3), 0x3e60772c096d61b7},
  };
  for (const Spot& spot : spots)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(spot.value), spot.bits)
        << spot.what << std::hex << " 0x" << std::bit_cast<std::uint64_t>(spot.value);
}

}  // namespace
}  // namespace contort
