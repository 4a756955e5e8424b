// Compares nearest and deepest points with signed_distance of the solids, and of the points.
#include "model/geometry/nearest_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/geometry/solids.h"

namespace contort {

namespace {

using namespace test_solids;

double depth_of(const Vec3& point, const Solid& solid) {
  return signed_distance(solid_of(Sphere{point, 0.0}), solid, kNoBand);
}

struct NearestPair {
  Core a, b;
};

class NearestPointsOf : public testing::TestWithParam<NearestPair> {};

// Worst measured over 400 pairs of each kind: 6e-16. The points on surfaces are hard cases of signed_distance itself.
TEST_P(NearestPointsOf, LieOnTheSurfacesAsFarApartAsTheSolids) {
  Random random(0xc0de + 7 * static_cast<std::uint64_t>(GetParam().a) + static_cast<std::uint64_t>(GetParam().b));
  for (int i = 0; i < 400; ++i) {
    const Solid a = random_solid(random, GetParam().a), b = random_solid(random, GetParam().b);
    const NearestPoints points = nearest_points(a, b);
    ASSERT_EQ(points.distance_m, signed_distance(a, b, kNoBand));
    const Vec3 nearest_between = points.on_b_m - points.on_a_m;
    ASSERT_NEAR(std::sqrt(glm::dot(nearest_between, nearest_between)), std::fabs(points.distance_m), 1e-6)
        << "pair " << i;
    ASSERT_NEAR(depth_of(points.on_a_m, a), 0.0, 1e-6) << "pair " << i;
    ASSERT_NEAR(depth_of(points.on_b_m, b), 0.0, 1e-6) << "pair " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(AllCores, NearestPointsOf, testing::ValuesIn([] {
                           std::vector<NearestPair> pairs;
                           for (const Core a : kCores)
                             for (const Core b : kCores) pairs.push_back({a, b});
                           return pairs;
                         }()),
                         [](const auto& test) {
                           return std::string(name_of(test.param.a)) + "_" + name_of(test.param.b);
                         });

NearestPoints nearest_between(const ColliderShape& a, const ColliderShape& b) {
  return nearest_points(solid_of(a), solid_of(b));
}

void expect_near(const Vec3& is, const Vec3& expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(is[i], expected[i], 1e-6) << "axis " << i;
}

TEST(NearestPoints, OfBallsLieBetweenThem) {
  const NearestPoints points = nearest_between(Sphere{{0, 0, 0}, 0.1}, Sphere{{1, 0, 0}, 0.2});
  expect_near(points.on_a_m, {0.1, 0, 0});
  expect_near(points.on_b_m, {0.8, 0, 0});
}

TEST(NearestPoints, OfBallsThatOverlapAreTheDeepest) {
  const NearestPoints points = nearest_between(Sphere{{0, 0, 0}, 0.1}, Sphere{{0.25, 0, 0}, 0.2});
  EXPECT_NEAR(points.distance_m, -0.05, 1e-12);
  expect_near(points.on_a_m, {0.1, 0, 0});
  expect_near(points.on_b_m, {0.05, 0, 0});
}

TEST(NearestPoints, OfABoxInABoxAreTheMiddleOfWhatLiesOverEachOther) {
  const NearestPoints points = nearest_between(Box{{0, 0, 0}, Vec3(0.5), {}},
                                               Box{{0.3, 0.55, 0}, {0.4, 0.1, 0.2}, {}});  // reaches beyond x = 0.5
  EXPECT_NEAR(points.distance_m, -0.05, 1e-12);
  expect_near(points.on_a_m, {0.2, 0.5, 0});
  expect_near(points.on_b_m, {0.2, 0.45, 0});
}

TEST(NearestPoints, OfParallelCapsulesAreTheMiddleOfWhatRunsSideBySide) {
  const NearestPoints points =
      nearest_between(Capsule{{0, 0, 0}, {0, 1, 0}, 0.1}, Capsule{{0.5, 0.4, 0}, {0.5, 2, 0}, 0.1});
  expect_near(points.on_a_m, {0.1, 0.7, 0});
  expect_near(points.on_b_m, {0.4, 0.7, 0});
}

TEST(NearestPoints, OfWhatHasNoPlaceSaySo) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(nearest_between(Sphere{{nan, 0, 0}, 0.1}, Sphere{{1, 0, 0}, 0.2}).distance_m));
}

}  // namespace

}  // namespace contort
