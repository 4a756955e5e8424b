// Compares pairs of spheres and capsules together with one pair at a time: the bits are equal, for all instructions of
// the machine.
#include "model/geometry/round_distances.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <ostream>

#include "tests/geometry/solids.h"

namespace contort {

namespace {

using namespace test_solids;

}  // namespace

void PrintTo(const RoundKernel& kernel, std::ostream* out) { *out << kernel.name; }

namespace {

class RoundKernels : public testing::TestWithParam<RoundKernel> {};

std::vector<ColliderPair> all_pairs(int count) {
  std::vector<ColliderPair> pairs;
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) pairs.push_back({a, b});
  return pairs;
}

void expect_same_bits(const std::vector<Solid>& solids, const RoundKernel& kernel) {
  const std::vector<ColliderPair> pairs = all_pairs(static_cast<int>(solids.size()));
  std::vector<double> distances_m(pairs.size(), -1.0);
  round_distances(solids, pairs, distances_m, kernel);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Solid &a = solids[static_cast<std::size_t>(pairs[i].a)], &b = solids[static_cast<std::size_t>(pairs[i].b)];
    const double one = signed_distance(a, b, kNoBand);
    if (std::isnan(one))
      EXPECT_TRUE(std::isnan(distances_m[i])) << pairs[i].a << ", " << pairs[i].b;
    else
      EXPECT_EQ(std::bit_cast<std::uint64_t>(distances_m[i]), std::bit_cast<std::uint64_t>(one))
          << pairs[i].a << ", " << pairs[i].b << ": " << distances_m[i] << " and " << one;
  }
}

TEST_P(RoundKernels, FindWhatOnePairAtATimeFinds) {
  Random random(5);
  for (std::size_t count = 0; count < 24; ++count)
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::vector<Solid> solids;
      for (std::size_t i = 0; i < count; ++i)
        solids.push_back(random_solid(random, random.uniform(0.0, 1.0) < 0.2 ? Core::point : Core::segment));
      expect_same_bits(solids, GetParam());
    }
}

Solid capsule(const Vec3& a, const Vec3& b, double radius_m) { return solid_of(Capsule{a, b, radius_m}); }

// Limbs of a figure at rest: many are parallel, some lie in one line, ends and middles meet.
TEST_P(RoundKernels, ParallelAndTouchingCapsulesAreNoExceptions) {
  std::vector<Solid> solids;
  for (int i = 0; i < 9; ++i) {
    const double x = 0.1 * i;
    solids.push_back(capsule({x, 0, 0}, {x, 1, 0}, 0.05));
    solids.push_back(capsule({x, 0, 0}, {x + 1e-9, 1, 1e-9}, 0.05));
    solids.push_back(capsule({x, 1, 0}, {x, 2, 0}, 0.05));
    solids.push_back(capsule({x, 1, 0}, {x + 1, 1, 0}, 0.05));
    solids.push_back(capsule({x, 0.5, 0}, {x, 0.5, 0}, 0.2));
  }
  expect_same_bits(solids, GetParam());
}

TEST_P(RoundKernels, WhatIsNoNumberSpoilsItsOwnPairsOnly) {
  Random random(6);
  for (std::size_t bad = 0; bad < 7; ++bad) {
    std::vector<Solid> solids;
    for (int i = 0; i < 7; ++i) solids.push_back(random_solid(random, Core::segment));
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200, 1e308}) {
      solids[bad].center_m.y = value;
      expect_same_bits(solids, GetParam());
    }
  }
}

TEST_P(RoundKernels, OverflowIsWhereOnePairAtATimeHasIt) {
  Solid solid = capsule({0, -0.1, 0}, {0, 0.1, 0}, 0.05);
  solid.center_m.x = 1e308;  // the sum of two is infinite, their difference is not
  Solid across = solid;
  across.axis = Vec3(0, 0, 1);
  expect_same_bits({solid, across, solid, across, solid}, GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, RoundKernels, testing::ValuesIn(round_kernels().begin(), round_kernels().end()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace

}  // namespace contort
