#include "generator/dynamics/shift_rows.h"

#include <gtest/gtest.h>

#include <vector>

namespace contort {
namespace {

constexpr double kWeight_N = 700.0, kSpread = 70.0 * 3600.0, kPendulum = 0.05;

std::vector<Vec3> shifts_of(std::vector<ShiftRow> rows) {
  std::vector<Vec3> shift_m(rows.size());
  solve_shift(rows, {kPendulum}, {kPendulum}, shift_m);
  return shift_m;
}

// A target with the same pose in all frames keeps standing.
TEST(ShiftRows, AreTheSameInAllFramesOfATargetThatStands) {
  for (const Vec3& shift_m : shifts_of(std::vector<ShiftRow>(50, {kSpread, kWeight_N, Vec3(-35.0, 0.0, 7.0)}))) {
    EXPECT_NEAR(shift_m.x, 0.05, 1e-12);
    EXPECT_NEAR(shift_m.z, -0.01, 1e-12);
  }
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
