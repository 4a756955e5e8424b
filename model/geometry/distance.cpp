#include "model/geometry/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/math.h"
#include "model/geometry/hull_distance.h"
#include "model/geometry/segment_distance.h"

namespace contort {

namespace {

Segment core_of(const Solid& round) { return {round.center_m, round.axis, round.half_length_m}; }

// The distance from an axis-aligned box at the origin to p; 0 inside.
double point_box_distance(const Vec3& p, const Vec3& half) { return length(glm::max(glm::abs(p) - half, Vec3(0.0))); }

// All further computations are in the frame of box A: A is centred at the origin with half sides `half`; B is a point,
// a segment or a box.
struct Local {
  Vec3 half;
  Vec3 center;   // centre of B
  Vec3 axis[3];  // unit axes of B: three for a box, one for a segment, none for a point
  Vec3 size;     // half sizes of B along each axis
  int axis_count;

  Vec3 reach(int i) const { return size[i] * axis[i]; }
};

Local in_box_frame(const Solid& box, const Solid& other) {
  const Mat3 to_box = glm::transpose(box.axes);
  Local local{box.half_m, to_box * (other.center_m - box.center_m), {}, Vec3(0.0), 0};
  const auto add = [&](const Vec3& axis, double half) {
    local.size[local.axis_count] = half;
    local.axis[local.axis_count++] = to_box * axis;
  };
  if (other.core == Solid::Core::segment) add(other.axis, other.half_length_m);
  if (other.core == Solid::Core::box)
    for (int i = 0; i < 3; ++i) add(other.axes[i], other.half_m[i]);
  return local;
}

// A direction along which A and B are separated by `gap` (negative: they overlap by at least that much along all
// directions).
struct BoxSeparation {
  double gap = -std::numeric_limits<double>::infinity();
  Vec3 axis{0.0};  // unit
};

// The gap between the projections of A and B on the unit axis n; negative if they overlap.
double gap_along(const Local& l, const Vec3& n) {
  double gap = std::fabs(glm::dot(l.center, n)) - glm::dot(l.half, glm::abs(n));
  for (int i = 0; i < l.axis_count; ++i) gap -= l.size[i] * std::fabs(glm::dot(l.axis[i], n));
  return gap;
}

// The greatest gap over all face normals of the Minkowski difference: > 0 is a lower bound of the distance, <= 0 is
// minus the depth (separating axis theorem: Gottschalk, Lin, Manocha 1996). Stops at the first gap greater than
// `enough`.
BoxSeparation box_separation(const Local& l, double enough) {
  BoxSeparation best;
  Vec3 faces = glm::abs(l.center) - l.half;
  for (int i = 0; i < l.axis_count; ++i) faces -= l.size[i] * glm::abs(l.axis[i]);
  for (int i = 0; i < 3; ++i)
    if (faces[i] > best.gap) best = {faces[i], Vec3(i == 0, i == 1, i == 2)};
  const auto try_axis = [&](const Vec3& n) {
    const double gap = gap_along(l, n);
    if (gap > best.gap) best = {gap, n};
  };
  const auto try_edges = [&](const Vec3& across) {
    const double size = length(across);
    if (size > 1e-9) try_axis(across / size);
  };
  if (best.gap > enough) return best;
  if (l.axis_count == 3)
    for (int i = 0; i < 3; ++i) try_axis(l.axis[i]);  // these are also the normals of a box's faces
  if (best.gap > enough) return best;
  for (int b = 0; b < l.axis_count; ++b) {
    const Vec3& d = l.axis[b];
    try_edges(Vec3(0.0, -d.z, d.y));
    try_edges(Vec3(d.z, 0.0, -d.x));
    try_edges(Vec3(-d.y, d.x, 0.0));
  }
  return best;
}

// The least distance of the corners of B to A; for a box also of the corners of A to B.
double nearest_corners(const Local& l) {
  double best = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < (1 << l.axis_count); ++corner) {
    Vec3 p = l.center;
    for (int i = 0; i < l.axis_count; ++i) p += (corner >> i & 1 ? 1.0 : -1.0) * l.reach(i);
    best = std::min(best, point_box_distance(p, l.half));
  }
  if (l.axis_count < 3) return best;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p = -l.center;
    for (int i = 0; i < 3; ++i) p[i] += corner >> i & 1 ? l.half[i] : -l.half[i];
    Vec3 in_b;
    for (int i = 0; i < 3; ++i) in_b[i] = glm::dot(p, l.axis[i]);
    best = std::min(best, point_box_distance(in_b, l.size));
  }
  return best;
}

// The edges of a box, at most twelve.
struct Edges {
  Segment edge[12];
  int count = 0;
};

// The edges of the box (centre, unit axes, half sides) that reach to within `slack` of its farthest point along n. If
// two solids have a gap of `gap` along n and a distance of at most gap + slack, their nearest points are on these
// edges.
Edges edges_ahead(const Vec3& center, const Vec3 (&axes)[3], const Vec3& half, const Vec3& n, double slack) {
  double reach[3];
  for (int i = 0; i < 3; ++i) reach[i] = half[i] * glm::dot(axes[i], n);
  const double front = std::fabs(reach[0]) + std::fabs(reach[1]) + std::fabs(reach[2]);
  Edges out;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    for (const double u : {-1.0, 1.0})
      for (const double v : {-1.0, 1.0})
        if (u * reach[j] + v * reach[k] + std::fabs(reach[i]) >= front - slack)
          out.edge[out.count++] = {center + u * half[j] * axes[j] + v * half[k] * axes[k], axes[i], half[i]};
  }
  return out;
}

double nearest_edges(const Local& l, const BoxSeparation& apart, double best) {
  constexpr Vec3 kAxes[3] = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const Vec3 towards_b = glm::dot(l.center, apart.axis) < 0.0 ? -apart.axis : apart.axis;
  const double slack = best - apart.gap + 1e-9;
  const Edges of_a = edges_ahead(Vec3(0.0), kAxes, l.half, towards_b, slack);
  const Edges of_b = l.axis_count == 3 ? edges_ahead(l.center, l.axis, l.size, -towards_b, slack)
                                       : Edges{{{l.center, l.axis[0], l.size[0]}}, 1};
  for (int a = 0; a < of_a.count; ++a)
    for (int b = 0; b < of_b.count; ++b) best = std::min(best, segment_distance(of_a.edge[a], of_b.edge[b]));
  return best;
}

// The nearest points of two convex polytopes that are apart are on a corner and a face, or on two edges. `way` as in
// signed_distance.
double box_distance(const Solid& box, const Solid& other, double band_m, Vec3& way) {
  const Local l = in_box_frame(box, other);
  const BoxSeparation apart = box_separation(l, band_m);
  way = box.axes * (glm::dot(l.center, apart.axis) < 0.0 ? -apart.axis : apart.axis);
  if (apart.gap <= 0.0 || apart.gap > band_m) return apart.gap;
  return l.axis_count == 0 ? point_box_distance(l.center, l.half) : nearest_edges(l, apart, nearest_corners(l));
}

double round_distance(const Solid& a, const Solid& b, Vec3& way) {
  const Vec3 back = between_segments(core_of(a), core_of(b));
  const double distance = length(back);
  way = distance > 1e-6 ? back / -distance : Vec3(0.0);
  return distance;
}

double core_distance(const Solid& a, const Solid& b, double band_m, Vec3& way) {
  if (a.core == Solid::Core::hull) return hull_distance(a, b, band_m);
  if (b.core == Solid::Core::hull) return hull_distance(b, a, band_m);
  if (a.core == Solid::Core::box) return box_distance(a, b, band_m, way);
  if (b.core != Solid::Core::box) return round_distance(a, b, way);
  const double distance = box_distance(b, a, band_m, way);
  way = -way;
  return distance;
}

Solid hull_solid(std::shared_ptr<const Polyhedron> hull) {
  Solid solid{Solid::Core::hull, hull->center_m};
  for (const Vec3& corner : hull->corners_m) solid.bound_m = std::max(solid.bound_m, length(corner));
  solid.hull = std::move(hull);
  return solid;
}

struct MakeSolid {
  Solid operator()(const Sphere& s) const {
    Solid solid{Solid::Core::point, s.center_m};
    solid.radius_m = solid.bound_m = s.radius_m;
    return solid;
  }
  Solid operator()(const Capsule& c) const {
    const Segment segment = segment_between(c.a_m, c.b_m);
    Solid solid{Solid::Core::segment, segment.center, segment.axis, segment.half_length};
    solid.radius_m = c.radius_m;
    solid.bound_m = segment.half_length + c.radius_m;
    return solid;
  }
  Solid operator()(const Box& b) const {
    Solid solid{Solid::Core::box, b.center_m};
    solid.axes = glm::mat3_cast(from_rotation_vector(b.rotation_deg * kRadPerDeg));
    solid.half_m = b.half_m;
    solid.bound_m = length(b.half_m);
    return solid;
  }
  Solid operator()(const ConvexHull& hull) const {
    return hull_solid(std::make_shared<Polyhedron>(convex_polyhedron(hull.points_m)));
  }
};

}  // namespace

Solid solid_of(const ColliderShape& shape) { return std::visit(MakeSolid{}, shape); }

Solid solid_of(const Collider& collider) {
  return collider.polyhedron ? hull_solid(collider.polyhedron) : solid_of(collider.shape);
}

Solid moved(const Rigid& to_from_own, const Solid& solid) {
  Solid out = solid;
  place(to_from_own, solid, out);
  return out;
}

void place(const Rigid& to_from_own, const Solid& solid, Solid& placed) {
  placed.center_m = to_from_own * solid.center_m;
  if (solid.core == Solid::Core::segment) placed.axis = to_from_own.q * solid.axis;
  if (solid.core == Solid::Core::box || solid.core == Solid::Core::hull)
    placed.axes = glm::mat3_cast(to_from_own.q) * solid.axes;
}

double extent_along(const Solid& solid, const Vec3& n) {
  double extent = solid.half_length_m * std::fabs(glm::dot(solid.axis, n));
  if (solid.core == Solid::Core::box) extent = glm::dot(glm::abs(glm::transpose(solid.axes) * n), solid.half_m);
  if (solid.core == Solid::Core::hull) {
    const Vec3 own = glm::transpose(solid.axes) * n;
    for (const Vec3& corner : solid.hull->corners_m) extent = std::max(extent, glm::dot(corner, own));
  }
  return extent + solid.radius_m;
}

double gap_along(const Solid& a, const Solid& b, const Vec3& n) {
  return glm::dot(b.center_m - a.center_m, n) - extent_along(a, n) - extent_along(b, -n);
}

Vec3 way_out(const Solid& a, const Solid& b) {
  constexpr double kNoBand = std::numeric_limits<double>::infinity();
  Vec3 way;
  const double here_m = signed_distance(a, b, kNoBand, way);
  if (way != Vec3(0.0)) return way;
  constexpr double kStep_m = 1e-7;  // accurate enough for differences
  for (int i = 0; i < 3; ++i) {
    Solid moved_b = b;
    moved_b.center_m[i] += kStep_m;
    way[i] = (signed_distance(a, moved_b, kNoBand) - here_m) / kStep_m;
  }
  return unit_or(way, Vec3(0, 1, 0));
}

double signed_distance(const Solid& a, const Solid& b, double band_m, Vec3& way) {
  way = Vec3(0.0);
  const double poison = a.center_m.x + a.center_m.y + a.center_m.z + b.center_m.x + b.center_m.y + b.center_m.z;
  if (!std::isfinite(poison)) return std::numeric_limits<double>::quiet_NaN();
  const double radii = a.radius_m + b.radius_m;
  return core_distance(a, b, band_m + radii, way) - radii;
}

double signed_distance(const Solid& a, const Solid& b, double band_m) {
  Vec3 way;
  return signed_distance(a, b, band_m, way);
}

}  // namespace contort
