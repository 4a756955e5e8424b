#include "formats/robot/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "model/character/polyhedron.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kLeast_m = 1e-4;
constexpr double kGreatest_m = 100.0;
constexpr int kCylinderSides = 16;
constexpr int kDirections = 62;

// Directions spread evenly over the sphere: points of a spiral with the golden angle (Swinbank and Purser, Q. J. R.
// Meteorol. Soc. 132, 2006).
std::vector<Vec3> spread_directions() {
  const double golden_rad = kPi * (3.0 - std::sqrt(5.0));
  std::vector<Vec3> out;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
    const double r = std::sqrt(1.0 - z * z);
    const det::SinCos turn = det::sincos(golden_rad * i);
    out.emplace_back(r * turn.cos, r * turn.sin, z);
  }
  return out;
}

bool is_place(const Vec3& p) {
  return std::fabs(p.x) <= kGreatest_m && std::fabs(p.y) <= kGreatest_m && std::fabs(p.z) <= kGreatest_m;
}
bool is_size(double size_m) { return size_m >= kLeast_m && size_m <= kGreatest_m; }

struct IsSolid {
  bool operator()(const Sphere& s) const { return is_place(s.center_m) && is_size(s.radius_m); }
  bool operator()(const Capsule& c) const { return is_place(c.a_m) && is_place(c.b_m) && is_size(c.radius_m); }
  bool operator()(const Box& b) const {
    return is_place(b.center_m) && is_size(b.half_m.x) && is_size(b.half_m.y) && is_size(b.half_m.z);
  }
  bool operator()(const ConvexHull& hull) const {
    return std::all_of(hull.points_m.begin(), hull.points_m.end(), is_place) && hull_fault(hull.points_m).empty();
  }
};

}  // namespace

ColliderShape placed_box(const Rigid& at, const Vec3& half_m) {
  return Box{at.p_m, half_m, to_rotation_vector(at.q) * kDegPerRad};
}

ColliderShape placed_capsule(const Rigid& at, double radius_m, double half_length_m) {
  return Capsule{at * Vec3(0, 0, -half_length_m), at * Vec3(0, 0, half_length_m), radius_m};
}

ColliderShape placed_cylinder(const Rigid& at, double radius_m, double half_length_m) {
  ConvexHull hull;
  for (int i = 0; i < kCylinderSides; ++i) {
    const det::SinCos turn = det::sincos(2.0 * kPi * i / kCylinderSides);
    for (const double z : {-half_length_m, half_length_m})
      hull.points_m.push_back(at * Vec3(radius_m * turn.cos, radius_m * turn.sin, z));
  }
  return hull;
}

ColliderShape placed_ellipsoid(const Rigid& at, const Vec3& radii_m) {
  ConvexHull hull;
  for (const Vec3& direction : spread_directions()) hull.points_m.push_back(at * (radii_m * direction));
  return hull;
}

ConvexHull hull_around(std::span<const Vec3> points_m) {
  ConvexHull hull;
  if (points_m.empty()) return hull;
  for (const Vec3& direction : spread_directions()) {
    const Vec3* farthest = &points_m[0];
    for (const Vec3& p : points_m)
      if (glm::dot(p, direction) > glm::dot(*farthest, direction)) farthest = &p;
    if (std::find(hull.points_m.begin(), hull.points_m.end(), *farthest) == hull.points_m.end())
      hull.points_m.push_back(*farthest);
  }
  if (!is_solid(hull)) hull.points_m.clear();
  return hull;
}

ColliderShape moved_shape(const Rigid& to_from_own, const ColliderShape& shape) {
  struct Move {
    const Rigid& move;
    ColliderShape operator()(const Sphere& s) const { return Sphere{move * s.center_m, s.radius_m}; }
    ColliderShape operator()(const Capsule& c) const { return Capsule{move * c.a_m, move * c.b_m, c.radius_m}; }
    ColliderShape operator()(const Box& b) const {
      return placed_box({move.q * from_rotation_vector(b.rotation_deg * kRadPerDeg), move * b.center_m}, b.half_m);
    }
    ColliderShape operator()(ConvexHull hull) const {
      for (Vec3& p : hull.points_m) p = move * p;
      return hull;
    }
  };
  return std::visit(Move{to_from_own}, shape);
}

bool is_solid(const ColliderShape& shape) { return std::visit(IsSolid{}, shape); }

}  // namespace contort
