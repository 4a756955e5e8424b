#include "renders/arrow.h"

#include <algorithm>

#include "model/core/detmath.h"

namespace contort {
namespace {

constexpr int kSides = 12;
constexpr double kShaftRadius_m = 0.011;
constexpr double kHeadRadius_m = 0.030;
constexpr double kHeadLength_m = 0.065;
constexpr double kHeadShare = 0.6;  // part of a short arrow's length, so that it still has a shaft

Vec3 on_circle(int side, double radius_m, double height_m) {
  const det::SinCos turn = det::sincos(2.0 * kPi * (side % kSides) / kSides);
  return {radius_m * turn.sin, height_m, radius_m * turn.cos};
}

// The corners must be counter-clockwise seen from outside.
void add_triangle(Triangles& out, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = unit_or(glm::cross(b - a, c - a), Vec3(0, 1, 0));
  for (const Vec3& corner : {a, b, c}) {
    out.positions_m.push_back(corner);
    out.normals.push_back(normal);
  }
}

}  // namespace

Triangles arrow_triangles(double length_m) {
  const double size = std::min(1.0, kHeadShare * length_m / kHeadLength_m);
  const double shaft_m = size * kShaftRadius_m, head_m = size * kHeadRadius_m;
  const double neck_m = length_m - size * kHeadLength_m;
  Triangles arrow;
  for (int i = 0; i < kSides; ++i) {
    const auto ring = [&](int step, double radius_m, double height_m) {
      return on_circle(i + step, radius_m, height_m);
    };
    add_triangle(arrow, ring(0, shaft_m, 0.0), ring(1, shaft_m, 0.0), ring(1, shaft_m, neck_m));
    add_triangle(arrow, ring(0, shaft_m, 0.0), ring(1, shaft_m, neck_m), ring(0, shaft_m, neck_m));
    add_triangle(arrow, ring(1, shaft_m, 0.0), ring(0, shaft_m, 0.0), Vec3(0.0));
    add_triangle(arrow, ring(1, head_m, neck_m), ring(0, head_m, neck_m), Vec3(0.0, neck_m, 0.0));
    add_triangle(arrow, ring(0, head_m, neck_m), ring(1, head_m, neck_m), Vec3(0.0, length_m, 0.0));
  }
  return arrow;
}

Rigid arrow_place(const Vec3& from_m, const Vec3& along) { return {shortest_arc(Vec3(0, 1, 0), along), from_m}; }

}  // namespace contort
