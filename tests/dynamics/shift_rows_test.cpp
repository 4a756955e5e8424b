#include "generator/dynamics/shift_rows.h"

#include <gtest/gtest.h>

#include <vector>

namespace contort {
namespace {

constexpr double kWeight_N = 700.0, kSpread = 70.0 * 3600.0, kPendulum = 0.05;

std::vector<Vec3> shifts_of(std::vector<ShiftRow> rows, const Vec3& rest_m = Vec3(0.0)) {
  std::vector<Vec3> shift_m(rows.size());
  solve_shift(rows, {kPendulum, rest_m}, {kPendulum, rest_m}, shift_m);
  return shift_m;
}

// A target with the same pose in all frames keeps standing.
TEST(ShiftRows, AreTheSameInAllFramesOfATargetThatStands) {
  const Vec3 rest_m(0.05, 0.0, -0.01);
  for (const Vec3& shift_m : shifts_of(std::vector<ShiftRow>(50, {kSpread, kWeight_N, -kWeight_N * rest_m}), rest_m))
    EXPECT_LT(length(shift_m - rest_m), 1e-12);
}

// A frame at an end asks for as much as one in the middle: nothing is known of the time beyond it.
TEST(ShiftRows, AreSmallestAtAnEndThatOnlyAccelerates) {
  std::vector<ShiftRow> rows(101, {kSpread, kWeight_N, Vec3(0.0)});
  rows.front().ask.x = rows.back().ask.x = -kWeight_N;
  const std::vector<Vec3> shift_m = shifts_of(rows);
  EXPECT_GT(shift_m.front().x, 0.0);
  EXPECT_LT(shift_m.front().x, 0.05);
  EXPECT_NEAR(shift_m.front().x, shift_m.back().x, 1e-12);
}

TEST(ShiftRows, FadeBesideAFrameThatAsks) {
  std::vector<ShiftRow> rows(101, {kSpread, kWeight_N, Vec3(0.0)});
  rows[50].ask.x = -kWeight_N;
  const std::vector<Vec3> shift_m = shifts_of(rows);
  for (std::size_t f = 0; f < 50; ++f) {
    EXPECT_GT(shift_m[f].x, 0.0);
    EXPECT_LT(shift_m[f].x, shift_m[f + 1].x);
    EXPECT_NEAR(shift_m[f].x, shift_m[100 - f].x, 1e-12);
  }
}

}  // namespace
}  // namespace contort
