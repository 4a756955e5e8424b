// Everything stands in the frame of hull A, so that A is never moved; B is a point, a segment, a box or a hull.
//
// Apart: the algorithm of Gilbert, Johnson and Keerthi (1988) walks through the difference A - B towards the origin.
// Each step gives a point of the difference (the distance is no greater than its length) and a plane with all of the
// difference behind it (the distance is no less than the plane's). Once the two agree, the distance is proved. Where
// rounding keeps them apart (solids that all but touch), all pairs of features are measured instead.
//
// Overlapping: the greatest gap over the face normals of the Minkowski difference. They are the face normals of both
// solids, and the crossed edges whose arcs on the sphere of normals meet (Gregorius, GDC 2013).
#include "model/geometry/hull_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "model/core/index.h"
#include "model/core/math.h"
#include "model/geometry/segment_distance.h"

namespace contort {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostSteps = 64;
constexpr double kRounding_m = 1e-12;
constexpr double kProof = 1e-13;  // fraction of the solids' size: bounds this close prove a distance

// Solid B, placed in A's frame.
struct Other {
  std::array<Vec3, kMaxHullPoints> corners;
  std::size_t corner_count = 0;
  const Polyhedron* solid = nullptr;  // its faces and edges; null for a point or segment
  Mat3 a_from_b{1.0};                 // rotates its normals

  std::span<const Vec3> all() const { return {corners.data(), corner_count}; }
  Vec3 normal(int face) const { return a_from_b * solid->faces[at(face)].normal; }
  const Vec3& corner(int i) const { return corners[at(i)]; }
};

const Polyhedron& unit_cube() {
  static const Polyhedron cube = [] {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    return convex_polyhedron(corners);
  }();
  return cube;
}

Other posed_in_frame_of(const Solid& a, const Solid& b) {
  const Mat3 to_a = glm::transpose(a.axes);
  const Vec3 center = to_a * (b.center_m - a.center_m);
  Other out;
  const auto add = [&](const Vec3& from_center) { out.corners[out.corner_count++] = center + from_center; };
  if (b.core == Solid::Core::point) add(Vec3(0.0));
  if (b.core == Solid::Core::segment)
    for (const double end : {-1.0, 1.0}) add(end * b.half_length_m * (to_a * b.axis));
  if (b.core == Solid::Core::point || b.core == Solid::Core::segment) return out;
  const bool is_box = b.core == Solid::Core::box;
  out.solid = is_box ? &unit_cube() : b.hull.get();
  out.a_from_b = to_a * b.axes;
  const Vec3 scale = is_box ? b.half_m : Vec3(1.0);
  for (const Vec3& corner : out.solid->corners_m) add(out.a_from_b * (scale * corner));
  return out;
}

std::size_t lowest(std::span<const Vec3> points, const Vec3& along) {
  std::size_t best = 0;
  double least = kInfinity;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double d = glm::dot(points[i], along); d < least) least = d, best = i;
  return best;
}

double lowest_along(std::span<const Vec3> points, const Vec3& n) { return glm::dot(points[lowest(points, n)], n); }

// ---- apart: up to four points of the difference, and the point of their hull that is nearest to the origin

struct Simplex {
  std::array<Vec3, 4> points;
  int count = 0;
  Vec3 nearest{0.0};
  bool holds_origin = false;
};

Simplex corner_of(const Vec3& a) { return {{a}, 1, a, false}; }

Simplex nearer(const Simplex& l, const Simplex& r) {
  return glm::dot(r.nearest, r.nearest) < glm::dot(l.nearest, l.nearest) ? r : l;
}

Simplex nearest_of(const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double t = -glm::dot(a, along);
  const double size2 = glm::dot(along, along);
  if (t <= 0.0 || size2 == 0.0) return corner_of(a);
  if (t >= size2) return corner_of(b);
  return {{a, b}, 2, a + (t / size2) * along, false};
}

// If the origin projects into the triangle, that point is nearest, otherwise a point on the edge of the triangle.
Simplex nearest_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = glm::cross(b - a, c - a);
  const double size2 = glm::dot(n, n);
  const Simplex rim = nearer(nearer(nearest_of(a, b), nearest_of(b, c)), nearest_of(c, a));
  if (size2 == 0.0) return rim;
  const double u = glm::dot(glm::cross(b, c), n), v = glm::dot(glm::cross(c, a), n), w = glm::dot(glm::cross(a, b), n);
  if (u < 0.0 || v < 0.0 || w < 0.0) return rim;
  return {{a, b, c}, 3, (glm::dot(a, n) / size2) * n, false};
}

// If the origin is beyond a face of the tetrahedron, the nearest point is on that face.
Simplex nearest_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::array<std::array<Vec3, 4>, 4> faces{{{a, b, c, d}, {a, c, d, b}, {a, d, b, c}, {b, d, c, a}}};
  Simplex best{{a, b, c, d}, 4, Vec3(kInfinity), true};
  for (const auto& [p, q, r, opposite] : faces) {
    const Vec3 n = glm::cross(q - p, r - p);
    const double origin_side = -glm::dot(p, n), inner_side = glm::dot(opposite - p, n);
    if (origin_side * inner_side > 0.0) continue;  // the origin is on the inner side of this face
    best = nearer(best, nearest_of(p, q, r));
  }
  return best;
}

Simplex with(const Simplex& s, const Vec3& w) {
  if (s.count == 1) return nearest_of(s.points[0], w);
  if (s.count == 2) return nearest_of(s.points[0], s.points[1], w);
  return nearest_of(s.points[0], s.points[1], s.points[2], w);
}

struct Walk {
  double low = -kInfinity;  // lower bound of the distance
  double high = kInfinity;  // upper bound of the distance
};

Walk walk_to_origin(std::span<const Vec3> a, std::span<const Vec3> b, double enough, double proof) {
  Simplex simplex = corner_of(a[0] - b[0]);
  Walk walk;
  for (int step = 0; step < kMostSteps; ++step) {
    const double distance = length(simplex.nearest);
    if (!(distance < walk.high)) return walk;  // no progress beyond rounding
    walk.high = distance;
    if (distance <= proof) return walk;
    const Vec3 n = simplex.nearest / distance;
    const Vec3 next = a[lowest(a, n)] - b[lowest(b, -n)];
    walk.low = std::max(walk.low, glm::dot(next, n));
    if (walk.low > enough || walk.high - walk.low <= proof) return walk;
    simplex = with(simplex, next);
    if (simplex.holds_origin) return {-kInfinity, 0.0};
  }
  return walk;
}

// ---- overlapping

struct HullSeparation {
  double gap = -kInfinity;  // > 0: a lower bound of the distance; otherwise minus the depth
  Vec3 axis{0.0};           // unit, from A to B
  void try_axis(const Vec3& n, double g) {
    if (g > gap) gap = g, axis = n;
  }
};

// Decides whether n or -n is a normal of the edge between two faces with these normals, seen from the other solid's
// edge. Returns 1 for n, -1 for -n, 0 for neither.
double side_of(const Vec3& n, const Vec3& other_edge, const Vec3& left, const Vec3& right) {
  if (glm::dot(left, other_edge) * glm::dot(right, other_edge) >= 0.0) return 0.0;
  return glm::dot(n, left + right) > 0.0 ? 1.0 : -1.0;
}

// Tries normals across edges of A and one edge of B. A segment has all directions across it as normals; an edge of a
// solid has those between the normals of its two faces.
void try_edges(const Polyhedron& a, const Vec3& edge_b, const Vec3& on_b, const std::array<Vec3, 2>* normals_b,
               HullSeparation& best) {
  const double size2_b = glm::dot(edge_b, edge_b);
  for (const Polyhedron::Edge& edge : a.edges) {
    const Vec3& left = a.faces[at(edge.faces[0])].normal;
    const Vec3& right = a.faces[at(edge.faces[1])].normal;
    const Vec3& on_a = a.corners_m[at(edge.corners[0])];
    const Vec3 edge_a = a.corners_m[at(edge.corners[1])] - on_a;
    const Vec3 n = glm::cross(edge_a, edge_b);
    const double side = side_of(n, edge_b, left, right);
    if (side == 0.0) continue;
    if (normals_b != nullptr && side_of(n, edge_a, (*normals_b)[0], (*normals_b)[1]) != -side) continue;
    const double size2 = glm::dot(n, n);
    // Parallel edges: the adjacent faces cover this normal.
    if (size2 <= 1e-24 * size2_b * glm::dot(edge_a, edge_a)) continue;
    const Vec3 axis = (side / std::sqrt(size2)) * n;
    best.try_axis(axis, glm::dot(axis, on_b - on_a));
  }
}

HullSeparation hull_separation(const Polyhedron& a, const Other& b) {
  HullSeparation best;
  for (const Polyhedron::Face& face : a.faces)
    best.try_axis(face.normal, lowest_along(b.all(), face.normal) - glm::dot(a.corner_of(face, 0), face.normal));
  if (b.solid == nullptr) {
    if (b.corner_count == 2) try_edges(a, b.corner(1) - b.corner(0), b.corner(0), nullptr, best);
    return best;
  }
  for (std::size_t f = 0; f < b.solid->faces.size(); ++f) {
    const Vec3 n = b.normal(static_cast<int>(f));
    const Vec3& on = b.corner(b.solid->loops[at(b.solid->faces[f].first)]);
    best.try_axis(-n, lowest_along(a.corners_m, n) - glm::dot(on, n));
  }
  for (const Polyhedron::Edge& edge : b.solid->edges) {
    const std::array<Vec3, 2> normals{b.normal(edge.faces[0]), b.normal(edge.faces[1])};
    const Vec3& on_b = b.corner(edge.corners[0]);
    try_edges(a, b.corner(edge.corners[1]) - on_b, on_b, &normals, best);
  }
  return best;
}

// ---- nearly touching: all pairs of features. The nearest points of two polyhedra that are apart are on a corner and a
// face, or on two edges.

// The least distance of corners to the faces in front of which they lie, if the nearest point is inside the face.
double nearest_to_faces(std::span<const Vec3> corners, const Polyhedron& solid, std::span<const Vec3> solid_corners,
                        const Mat3& turn) {
  double best = kInfinity;
  for (const Polyhedron::Face& face : solid.faces) {
    const Vec3 n = turn * face.normal;
    const auto corner = [&](int i) -> const Vec3& {
      return solid_corners[at(solid.loops[at(face.first + i % face.count)])];
    };
    for (const Vec3& p : corners) {
      double height = glm::dot(n, p - corner(0));
      if (height < 0.0 && height > -kRounding_m)
        height = 0.0;  // the solids are apart, so the corner is on the face, apart from rounding
      if (height < 0.0 || height >= best) continue;
      bool above = true;
      for (int i = 0; i < face.count && above; ++i)
        above = glm::dot(glm::cross(corner(i + 1) - corner(i), p - corner(i)), n) >= 0.0;
      if (above) best = height;
    }
  }
  return best;
}

std::vector<Segment> edges_of(const Other& b) {
  if (b.solid == nullptr) return {segment_between(b.corner(0), b.corner(static_cast<int>(b.corner_count) - 1))};
  std::vector<Segment> edges;
  for (const Polyhedron::Edge& edge : b.solid->edges)
    edges.push_back(segment_between(b.corner(edge.corners[0]), b.corner(edge.corners[1])));
  return edges;
}

double nearest_features(const Polyhedron& a, const Other& b) {
  double best = nearest_to_faces(b.all(), a, a.corners_m, Mat3(1.0));
  if (b.solid != nullptr) best = std::min(best, nearest_to_faces(a.corners_m, *b.solid, b.all(), b.a_from_b));
  const std::vector<Segment> edges_b = edges_of(b);
  for (const Polyhedron::Edge& edge : a.edges) {
    const Segment edge_a = segment_between(a.corners_m[at(edge.corners[0])], a.corners_m[at(edge.corners[1])]);
    for (const Segment& edge_b : edges_b) best = std::min(best, segment_distance(edge_a, edge_b));
  }
  return best;
}

}  // namespace

double hull_distance(const Solid& a, const Solid& b, double band_m) {
  const Polyhedron& hull = *a.hull;
  const Other other = posed_in_frame_of(a, b);
  const double proof = kProof * (a.bound_m + b.bound_m);
  const Walk walk = walk_to_origin(hull.corners_m, other.all(), band_m, proof);
  if (walk.low > band_m) return walk.low;
  if (walk.high - walk.low <= proof) return walk.high;
  const HullSeparation apart = hull_separation(hull, other);
  return apart.gap <= 0.0 ? apart.gap : nearest_features(hull, other);
}

}  // namespace contort
