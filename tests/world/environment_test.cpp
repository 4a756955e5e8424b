// Ground and obstacles: queries by exemplars and against brute force.
#include "model/world/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "model/core/math.h"
#include "model/spec/spec.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

Environment built(const EnvironmentDesc& desc) {
  Result<Environment> environment = build_environment(desc);
  EXPECT_TRUE(environment.ok()) << (environment.ok() ? "" : to_line(environment.issue()));
  return environment ? std::move(environment).value() : Environment();
}

EnvironmentDesc with_ground(const Ground& ground) {
  EnvironmentDesc desc;
  desc.ground = ground;
  return desc;
}

TEST(Environment, SlopesRiseAlongTheirHeading) {
  const Environment east = built(with_ground(SlopeGround{45.0, 90.0}));
  EXPECT_NEAR(east.height_at(2.0, 7.0), 2.0, 1e-14);
  EXPECT_LT(length(east.normal_at(2.0, 7.0) - Vec3(-std::sqrt(0.5), std::sqrt(0.5), 0.0)), 1e-9);
  EXPECT_FALSE(east.is_level());
}

TEST(Environment, StepsAreLevelTreadsBetweenRisers) {
  const Environment steps = built(with_ground(StepsGround{0.0, 1.0, 0.5, 0.2, 3}));
  const std::pair<double, double> expected[] = {{-9.0, 0.0}, {0.99, 0.0}, {1.01, 0.2}, {1.49, 0.2},
                                                {1.51, 0.4}, {2.01, 0.6}, {50.0, 0.6}};
  for (const auto& [z, height] : expected) EXPECT_NEAR(steps.height_at(3.0, z), height, 1e-15) << z;
  EXPECT_EQ(steps.normal_at(0.0, 1.2), Vec3(0, 1, 0));
}

TEST(Environment, HeightsAreBilinearAndGoOnBeyondTheEdges) {
  HeightGround field;
  field.columns = 3, field.rows = 2, field.spacing_m = 2.0;
  field.heights_m = {0, 1, 2, 10, 11, 12};
  const Environment ground = built(with_ground(field));
  EXPECT_DOUBLE_EQ(ground.height_at(0.0, 0.0), 6.0);
  EXPECT_DOUBLE_EQ(ground.height_at(-2.0, -1.0), 0.0);
  EXPECT_DOUBLE_EQ(ground.height_at(2.0, 1.0), 12.0);
  EXPECT_DOUBLE_EQ(ground.height_at(99.0, -99.0), 2.0);
}

// Callers skip the balls that are surely over the ground, so the quick look may never be wrong; and it has to be of
// use.
TEST(Environment, AQuickLookAtTheGroundIsNeverWrongAndOfUse) {
  std::mt19937_64 random(3);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int round = 0; round < 400; ++round) {
    HeightGround grid;
    grid.columns = 2 + static_cast<int>(random() % 4), grid.rows = 2 + static_cast<int>(random() % 4);
    grid.spacing_m = any(0.2, 1.0), grid.heights_m.clear();
    for (int i = 0; i < grid.columns * grid.rows; ++i) grid.heights_m.push_back(any(-0.5, 0.5));
    const Ground grounds[] = {PlaneGround{any(-1, 1)}, SlopeGround{any(-25, 25), any(-180, 180)},
                              StepsGround{0.0, 1.0, 0.3, any(-0.2, 0.2), 5}, grid};
    EnvironmentDesc desc = with_ground(grounds[round % 4]);
    desc.heading_deg = any(-180, 180), desc.position_m = Vec3(any(-1, 1), any(-1, 1), any(-1, 1));
    const Environment environment = built(desc);
    for (int i = 0; i < 200; ++i) {
      const Vec3 center(any(-3, 3), any(-2, 4), any(-3, 3));
      const double radius_m = any(0.0, 0.5), distance_m = any(-0.3, 0.5);
      if (!environment.is_surely_over_ground(center, radius_m, distance_m)) continue;
      const Vec3 way(any(-1, 1), any(-1, 1), any(-1, 1));
      const Vec3 point = center + radius_m / std::max(1.0, glm::length(way)) * way;
      EXPECT_GT(environment.nearest_ground(point).distance_m, distance_m);
    }
    EXPECT_TRUE(environment.is_surely_over_ground(Vec3(0, 100, 0), 1.0, 1.0)) << round;
  }
  EXPECT_TRUE(Environment().is_surely_over_ground(Vec3(0, 1, 0), 0.5, 0.499));
  EXPECT_FALSE(Environment().is_surely_over_ground(Vec3(0, 1, 0), 0.5, 0.501));
}

TEST(Environment, ATurnedAndMovedOneAnswersTheSameThere) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  for (const Ground& ground : {Ground(SlopeGround{17.0, 30.0}), Ground(StepsGround{20.0, 0.3, 0.4, 0.1, 9}),
                               Ground(HeightGround{2, 2, 3.0, {0.1, 0.4, -0.2, 0.3}})}) {
    EnvironmentDesc desc = with_ground(ground);
    desc.obstacles = {{"post", Capsule{Vec3(1, 0, 1), Vec3(1, 2, 1), 0.2}},
                      {"box", Box{Vec3(-1, 1, 0), Vec3(0.3, 0.5, 0.2), Vec3(10, 20, 30)}}};
    const Environment here = built(desc);
    desc.position_m = Vec3(5.0, 1.5, -2.0), desc.heading_deg = 65.0;
    const Environment there = built(desc);
    const Rigid moved{axis_angle(Vec3(0, 1, 0), 65.0 * kRadPerDeg), desc.position_m};
    for (int i = 0; i < 200; ++i) {
      const Vec3 point(place(engine), place(engine), place(engine)), other = moved * point;
      EXPECT_NEAR(there.height_at(other.x, other.z), here.height_at(point.x, point.z) + 1.5, 1e-9);
      const Surface a = here.nearest_obstacle(point), b = there.nearest_obstacle(other);
      EXPECT_EQ(a.obstacle, b.obstacle);
      EXPECT_NEAR(a.distance_m, b.distance_m, 1e-12);
      EXPECT_LT(length(moved * a.point_m - b.point_m), 1e-9);
    }
  }
}

// Points all over a box: none is nearer than the returned one, and one is equally near.
TEST(Environment, TheNearestPointOfABoxIsNearest) {
  const Box box{Vec3(0.2, 0.5, -0.1), Vec3(0.3, 0.6, 0.2), Vec3(20.0, 35.0, -10.0)};
  EnvironmentDesc desc;
  desc.obstacles = {{"box", box}};
  const Environment environment = built(desc);
  const Quat q = from_rotation_vector(box.rotation_deg * kRadPerDeg);
  std::mt19937_64 engine(9);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  constexpr int kGrid = 40;
  for (int i = 0; i < 60; ++i) {
    const Vec3 point(place(engine), place(engine), place(engine));
    const Surface nearest = environment.nearest_obstacle(point);
    double least = 1e9;
    for (int face = 0; face < 6; ++face)
      for (int a = 0; a <= kGrid; ++a)
        for (int b = 0; b <= kGrid; ++b) {
          Vec3 local;
          local[face % 3] = face < 3 ? 1.0 : -1.0;
          local[(face + 1) % 3] = 2.0 * a / kGrid - 1.0;
          local[(face + 2) % 3] = 2.0 * b / kGrid - 1.0;
          least = std::min(least, length(box.center_m + q * (local * box.half_m) - point));
        }
    const Vec3 inside = glm::conjugate(q) * (point - box.center_m);
    const bool is_inside =
        std::fabs(inside.x) < box.half_m.x && std::fabs(inside.y) < box.half_m.y && std::fabs(inside.z) < box.half_m.z;
    EXPECT_EQ(nearest.distance_m < 0.0, is_inside);
    EXPECT_LE(std::fabs(nearest.distance_m), least + 1e-12);
    EXPECT_GT(std::fabs(nearest.distance_m), least - 0.03) << "the grid's own spacing";
    EXPECT_NEAR(length(nearest.point_m - point), std::fabs(nearest.distance_m), 1e-12);
    EXPECT_NEAR(length(nearest.normal), 1.0, 1e-12);
  }
}

TEST(Environment, ABoxAsAHullIsTheSameObstacle) {
  const Box box{Vec3(0.2, 0.5, -0.1), Vec3(0.3, 0.6, 0.2), Vec3(20.0, 35.0, -10.0)};
  ConvexHull hull;
  for (int i = 0; i < 8; ++i) {
    const Vec3 side(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    hull.points_m.push_back(box.center_m + from_rotation_vector(box.rotation_deg * kRadPerDeg) * (side * box.half_m));
  }
  EnvironmentDesc as_box, as_hull;
  as_box.obstacles = {{"box", box}}, as_hull.obstacles = {{"box", hull}};
  as_box.heading_deg = as_hull.heading_deg = 40.0;
  const Environment a = built(as_box), b = built(as_hull);
  std::mt19937_64 engine(9);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (int i = 0; i < 300; ++i) {
    const Vec3 point(place(engine), place(engine), place(engine));
    EXPECT_NEAR(a.nearest_obstacle(point).distance_m, b.nearest_obstacle(point).distance_m, 1e-12);
    EXPECT_LT(length(a.nearest_obstacle(point).point_m - b.nearest_obstacle(point).point_m), 1e-9);
  }
}

TEST(Environment, WhatDoesNotFitTogetherIsRefused) {
  EnvironmentDesc desc = with_ground(HeightGround{3, 3, 1.0, {0, 0}});
  EXPECT_EQ(build_environment(desc).issue().code, "environment.wrong_count");
  EXPECT_EQ(build_environment(desc).issue().pointer, "/ground/heights_m");
  desc = {};
  desc.obstacles = {{"a", Sphere{}}, {"a", Sphere{}}};
  EXPECT_EQ(build_environment(desc).issue().code, "environment.duplicate_name");
  EXPECT_EQ(build_environment(desc).issue().pointer, "/obstacles/1/name");
  desc.obstacles = {{"a", ConvexHull{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}}}};
  EXPECT_EQ(build_environment(desc).issue().code, "environment.bad_shape");
  EXPECT_EQ(build_environment(desc).issue().pointer, "/obstacles/0/shape/points_m");
}

TEST(Environment, SpecsReadAndPrintIt) {
  const Result<Spec> spec = parse_spec(R"({"format":"contort.spec/1","character":{"name":"human"},"environment":{
    "ground":{"type":"slope","slope_deg":12},"obstacles":[{"name":"w","shape":{"type":"sphere","radius_m":0.5}}]}})");
  ASSERT_TRUE(spec.ok()) << to_line(spec.issue());
  EXPECT_EQ(*parse_spec(print_spec(*spec)), *spec);
  const Result<Spec> lava = parse_spec(
      R"({"format":"contort.spec/1","character":{"name":"human"},"environment":{"ground":{"type":"lava"}}})");
  ASSERT_FALSE(lava.ok());
  EXPECT_EQ(lava.issue().pointer, "/environment/ground/type");
}

// A figure with a NaN root once got a grid index far out of the list.
TEST(Environment, APlaceThatIsNoNumberHasNoHeight) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Environment heights = built(with_ground(HeightGround{7, 3, 0.5, std::vector<double>(21, 1.0)}));
  EXPECT_TRUE(std::isnan(heights.height_at(nan, 0.0)));
  EXPECT_TRUE(std::isnan(heights.height_at(0.0, nan)));
  EXPECT_TRUE(std::isnan(heights.nearest_ground({nan, nan, nan}).distance_m));
  EXPECT_EQ(heights.height_at(1e300, -1e300), 1.0) << "beyond the edges as at them";
}

}  // namespace
}  // namespace contort
