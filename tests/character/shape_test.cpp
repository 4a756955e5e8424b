// The drawn shapes are closed, face outward and fill the colliding shapes.
#include "model/character/shape.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "model/character/polyhedron.h"
#include "tests/core/random_space.h"

namespace contort {
namespace {

using fixtures::any_vec;
using fixtures::lattice_number;

// Divergence theorem: the sum of a . (b x c) / 6 over outward triangles.
double volume(const Triangles& t) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < t.positions_m.size(); i += 3)
    sum += glm::dot(t.positions_m[i], glm::cross(t.positions_m[i + 1], t.positions_m[i + 2])) / 6.0;
  return sum;
}

using Corner = std::array<std::int64_t, 3>;
Corner corner_of(const Vec3& p) { return {std::llround(p.x * 1e8), std::llround(p.y * 1e8), std::llround(p.z * 1e8)}; }

// Every edge is walked once in each direction.
bool closed(const Triangles& t) {
  std::map<std::pair<Corner, Corner>, int> balance;
  for (std::size_t i = 0; i + 2 < t.positions_m.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner a = corner_of(t.positions_m[i + k]);
      const Corner b = corner_of(t.positions_m[i + (k + 1) % 3]);
      if (a == b) continue;
      ++balance[{a, b}];
      --balance[{b, a}];
    }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

// No triangle without area, every normal a unit that looks to the same side as its triangle.
bool normals_fit(const Triangles& t) {
  for (std::size_t i = 0; i + 2 < t.positions_m.size(); i += 3) {
    const Vec3 cross = glm::cross(t.positions_m[i + 1] - t.positions_m[i], t.positions_m[i + 2] - t.positions_m[i]);
    if (!(glm::dot(cross, cross) > 0.0)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& normal = t.normals[i + k];
      if (std::fabs(glm::dot(normal, normal) - 1.0) > 1e-9 || glm::dot(normal, cross) <= 0.0) return false;
    }
  }
  return t.normals.size() == t.positions_m.size() && !t.normals.empty();
}

RC_GTEST_PROP(Shape, BoxesAreClosedAndFilled, ()) {
  const Box box{any_vec(2), Vec3(lattice_number(0.01, 1), lattice_number(0.01, 1), lattice_number(0.01, 1)),
                any_vec(360)};
  const Triangles t = tessellate(box);
  RC_ASSERT(t.positions_m.size() == 36U);
  RC_ASSERT(closed(t));
  RC_ASSERT(normals_fit(t));
  RC_ASSERT(std::fabs(volume(t) / (8 * box.half_m.x * box.half_m.y * box.half_m.z) - 1.0) < 1e-9);
}

// A polyhedron inside the round body: measured 0.937 of a sphere's volume, 0.974 of a long capsule's.
RC_GTEST_PROP(Shape, CapsulesAreClosedAndFilled, ()) {
  const Capsule c{any_vec(1), any_vec(1), lattice_number(0.02, 0.5)};
  const Vec3 axis = c.b_m - c.a_m;
  const double r = c.radius_m;
  const double whole = kPi * r * r * (std::sqrt(glm::dot(axis, axis)) + 4.0 / 3.0 * r);
  const Triangles t = tessellate(c);
  RC_ASSERT(closed(t));
  RC_ASSERT(normals_fit(t));
  RC_ASSERT(volume(t) / whole < 1.0);
  RC_ASSERT(volume(t) / whole > 0.9);
}

RC_GTEST_PROP(Shape, HullsAreClosedAndFilled, ()) {
  const Box box{any_vec(2), Vec3(lattice_number(0.01, 1), lattice_number(0.01, 1), lattice_number(0.01, 1)),
                any_vec(360)};
  ConvexHull hull{{box.center_m}};
  for (const Vec3& p : tessellate(box).positions_m) hull.points_m.push_back(p);
  const Triangles t = tessellate(hull);
  RC_ASSERT(t.positions_m.size() == 36U);
  RC_ASSERT(closed(t));
  RC_ASSERT(normals_fit(t));
  RC_ASSERT(std::fabs(volume(t) / (8 * box.half_m.x * box.half_m.y * box.half_m.z) - 1.0) < 1e-9);
}

TEST(Shape, SpheresAreClosedAndFilled) {
  const Triangles t = tessellate(Sphere{Vec3(1, -2, 3), 0.5});
  EXPECT_TRUE(closed(t));
  EXPECT_TRUE(normals_fit(t));
  EXPECT_NEAR(volume(t) / (4.0 / 3.0 * kPi * 0.125), 0.93, 0.02);
}

TEST(Shape, SmallThingsKeepTheirSurface) {
  EXPECT_TRUE(normals_fit(tessellate(Box{Vec3(0), Vec3(1e-4), Vec3(0)})));
  EXPECT_TRUE(closed(tessellate(Sphere{Vec3(0), 1e-3})));
}

TEST(Shape, TrianglesAreTakenAsTheyAre) {
  const TriangleMesh mesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
                          {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
  const Triangles t = tessellate(mesh);
  EXPECT_TRUE(closed(t));
  EXPECT_TRUE(normals_fit(t));
  EXPECT_NEAR(volume(t), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(volume(tessellate(mirrored(MeshShape(mesh)))), 1.0 / 6.0, 1e-15);
}

bool holds(const ColliderShape& shape, const Vec3& p) {
  if (const auto* s = std::get_if<Sphere>(&shape))
    return glm::dot(p - s->center_m, p - s->center_m) <= s->radius_m * s->radius_m;
  if (const auto* b = std::get_if<Box>(&shape)) {
    const Vec3 own = glm::conjugate(from_rotation_vector(b->rotation_deg * kRadPerDeg)) * (p - b->center_m);
    return std::fabs(own.x) <= b->half_m.x && std::fabs(own.y) <= b->half_m.y && std::fabs(own.z) <= b->half_m.z;
  }
  if (const auto* h = std::get_if<ConvexHull>(&shape))
    return nearest_on(convex_polyhedron(h->points_m), p).distance_m <= 0.0;
  const auto& c = std::get<Capsule>(shape);
  const Vec3 axis = c.b_m - c.a_m;
  const double along = std::clamp(glm::dot(p - c.a_m, axis) / std::max(glm::dot(axis, axis), 1e-30), 0.0, 1.0);
  const Vec3 d = p - c.a_m - along * axis;
  return glm::dot(d, d) <= c.radius_m * c.radius_m;
}

RC_GTEST_PROP(Shape, MirroredShapesHoldTheMirroredPoints, ()) {
  const ColliderShape shape = *rc::gen::element<ColliderShape>(
      Sphere{Vec3(0.3, -0.2, 0.1), 0.8}, Capsule{Vec3(-0.5, 0.1, 0.4), Vec3(0.6, 0.2, -0.3), 0.4},
      Box{Vec3(0.1, 0.2, 0.3), Vec3(0.4, 0.6, 0.8), Vec3(30, -50, 70)},
      ConvexHull{{Vec3(0.9, 0, 0), Vec3(-0.5, 0.8, 0), Vec3(0, -0.7, 0.3), Vec3(0.1, 0.2, 1), Vec3(0, 0, -0.8)}});
  const Vec3 p = any_vec(1.5);
  RC_ASSERT(holds(mirrored(shape), mirror_point(p)) == holds(shape, p));
  RC_ASSERT(mirrored(mirrored(shape)) == shape);
}

}  // namespace
}  // namespace contort
