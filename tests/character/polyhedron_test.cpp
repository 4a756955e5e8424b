#include "model/character/polyhedron.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "model/character/shape.h"
#include "model/core/math.h"
#include "tests/geometry/solids.h"

namespace contort {
namespace {

using test_solids::Random;

std::vector<Vec3> cube_points() {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  return points;
}

// Checks all properties of the surface of the points' convex hull.
void expect_hull_of(const Polyhedron& p, const std::vector<Vec3>& points, double tolerance) {
  ASSERT_EQ(p.corners_m.size() + p.faces.size(), p.edges.size() + 2);
  std::vector<std::set<int>> edges_of(p.faces.size());
  for (std::size_t e = 0; e < p.edges.size(); ++e)
    for (const int f : p.edges[e].faces) edges_of[static_cast<std::size_t>(f)].insert(static_cast<int>(e));
  for (std::size_t f = 0; f < p.faces.size(); ++f) {
    const Polyhedron::Face& face = p.faces[f];
    ASSERT_NEAR(length(face.normal), 1.0, 1e-12);
    ASSERT_EQ(edges_of[f].size(), static_cast<std::size_t>(face.count));
    for (const Vec3& point : points)
      ASSERT_LE(glm::dot(face.normal, point - p.center_m - p.corner_of(face, 0)), tolerance);
    for (int i = 0; i < face.count; ++i) {
      const Vec3 a = p.corner_of(face, i), b = p.corner_of(face, (i + 1) % face.count);
      const Vec3 c = p.corner_of(face, (i + 2) % face.count);
      ASSERT_NEAR(glm::dot(face.normal, b - a), 0.0, tolerance);
      ASSERT_GT(glm::dot(glm::cross(b - a, c - b), face.normal), 0.0);
    }
  }
  for (const Vec3& corner : p.corners_m)
    ASSERT_TRUE(std::any_of(points.begin(), points.end(),
                            [&](const Vec3& point) { return length(point - p.center_m - corner) <= tolerance; }));
}

bool are_flat(const std::vector<Vec3>& points) {  // exact for small whole numbers
  for (const Vec3& b : points)
    for (const Vec3& c : points)
      for (const Vec3& d : points)
        if (glm::dot(glm::cross(b - points[0], c - points[0]), d - points[0]) != 0.0) return false;
  return true;
}

// Whole numbers: many points in one plane, on one line, and twice.
RC_GTEST_PROP(Polyhedron, IsTheHullOfPointsOnALattice, ()) {
  const int reach = *rc::gen::inRange(1, 5);
  const auto whole = [&] { return static_cast<double>(*rc::gen::inRange(-reach, reach + 1)); };
  std::vector<Vec3> points(*rc::gen::inRange<std::size_t>(4, 25));
  for (Vec3& p : points) p = Vec3(whole(), whole(), whole());
  const Polyhedron hull = convex_polyhedron(points);
  RC_ASSERT(hull.faces.empty() == are_flat(points));
  if (!hull.faces.empty()) expect_hull_of(hull, points, 1e-9);
  RC_ASSERT(!testing::Test::HasFailure());
}

TEST(Polyhedron, IsTheHullOfSixtyFourPointsAndOfSlivers) {
  Random random(7);
  for (int i = 0; i < 60; ++i) {
    std::vector<Vec3> points;
    const Vec3 scale(1.0, 0.3, i % 3 == 0 ? 1e-4 : 0.5);
    for (int k = 0; k < (i % 2 == 0 ? kMaxHullPoints : 9); ++k)
      points.push_back(scale * (i % 4 < 2 ? random.direction() : random.in_cube(1.0)));
    const Polyhedron hull = convex_polyhedron(points);
    ASSERT_FALSE(hull.faces.empty()) << i;
    expect_hull_of(hull, points, 2e-9);
  }
}

TEST(Polyhedron, PointsInsideAndOnFacesAndEdgesAreNoCorners) {
  std::vector<Vec3> points{Vec3(0), Vec3(1, 0.5, 0.3), Vec3(1, 1, 0.2), Vec3(1, 1, 1)};
  for (const Vec3& corner : cube_points()) points.push_back(corner);
  const Polyhedron cube = convex_polyhedron(points);
  EXPECT_EQ(cube.corners_m.size(), 8U);
  EXPECT_EQ(cube.faces.size(), 6U);
  EXPECT_EQ(cube.edges.size(), 12U);
  EXPECT_LT(length(cube.center_m), 1e-15);
}

// Turning brings rounding into planes that were exact.
TEST(Polyhedron, ATurnedAndMovedCubeIsStillOne) {
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    const Rigid move = random.rigid(50.0);
    std::vector<Vec3> points = cube_points();
    for (Vec3& p : points) p = move * (0.1 * p);
    const Polyhedron cube = convex_polyhedron(points);
    ASSERT_EQ(cube.faces.size(), 6U) << i;
    ASSERT_EQ(cube.edges.size(), 12U) << i;
  }
}

TEST(Polyhedron, MovesAndMirrorsWithItsPoints) {
  Random random(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) points.push_back(random.in_cube(1.0));
  const Rigid move = random.rigid(1.0);
  const Polyhedron hull = convex_polyhedron(points);
  std::vector<Vec3> elsewhere = points, reflected = points;
  for (Vec3& p : elsewhere) p = move * p;
  for (Vec3& p : reflected) p = mirror_point(p);
  expect_hull_of(moved(move, hull), elsewhere, 1e-9);
  expect_hull_of(mirrored(hull), reflected, 1e-9);
  EXPECT_EQ(mirrored(mirrored(hull)).corners_m, hull.corners_m);
}

TEST(Polyhedron, TheNearestPointOfACubeHasAFormula) {
  Random random(5);
  const Polyhedron cube = convex_polyhedron(cube_points());
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random.in_cube(2.5);
    const Vec3 beyond = glm::abs(p) - Vec3(1.0);
    const double deepest = std::max({beyond.x, beyond.y, beyond.z});
    const OnSurface on = nearest_on(cube, p);
    ASSERT_NEAR(on.distance_m, deepest < 0.0 ? deepest : length(glm::max(beyond, Vec3(0.0))), 1e-12);
    ASSERT_NEAR(length(on.point_m + on.distance_m * on.normal - p), 0.0, 1e-12);
    ASSERT_NEAR(std::max({std::fabs(on.point_m.x), std::fabs(on.point_m.y), std::fabs(on.point_m.z)}), 1.0, 1e-12);
  }
}

TEST(Polyhedron, SaysWhyPointsAreNoHull) {
  std::vector<Vec3> points = cube_points();
  EXPECT_EQ(hull_fault(points), "");
  EXPECT_NE(hull_fault(std::vector<Vec3>(points.begin(), points.begin() + 4)), "") << "a square";
  EXPECT_NE(hull_fault(std::vector<Vec3>(points.begin(), points.begin() + 3)), "");
  EXPECT_NE(hull_fault(std::vector<Vec3>(kMaxHullPoints + 1, Vec3(0))), "");
  EXPECT_NE(hull_fault(std::vector<Vec3>(8, Vec3(1))), "");
  points[3].y = std::nan("");
  EXPECT_NE(hull_fault(points), "");
}

}  // namespace
}  // namespace contort
