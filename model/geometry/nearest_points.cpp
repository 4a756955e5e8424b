// Finds the features of both cores (a corner, an edge or a face) that touch the planes at right angles to the
// separating direction. The solids are nearest where these features overlap. The corners of this region are corners of
// one feature over the other, and crossings of their edges; so the middle of all of these is the middle of the region.
#include "model/geometry/nearest_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "model/core/detmath.h"
#include "model/geometry/segment_distance.h"
#include "model/geometry/solid_points.h"

namespace contort {

namespace {

constexpr double kFlat_m = 1e-5;   // points up to this far behind the foremost point belong to its feature
constexpr double kEqual_m = 1e-7;  // pairs that are longer by at most this count as equally near
// Distance to which features are moved apart, because the nearest edges of overlapping cores are others.
constexpr double kApart_m = 0.05;

constexpr double kNoBand = std::numeric_limits<double>::infinity();

// The unit vector along which b gets away from a fastest: from the nearest point of a to that of b, or the shortest way
// out. It is computed from distances, because way_out is only approximate.
Vec3 direction_apart(const Solid& a, const Solid& b) {
  constexpr double kStep_m = 1e-6;
  Vec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    Solid ahead = b, behind = b;
    ahead.center_m[axis] += kStep_m, behind.center_m[axis] -= kStep_m;
    slope[axis] = signed_distance(a, ahead, kNoBand) - signed_distance(a, behind, kNoBand);
  }
  return unit_or(slope, Vec3(0, 1, 0));
}

// The corners of a core that are foremost along the unit vector n, counter-clockwise around n.
std::vector<Vec3> feature_ahead(const Solid& solid, const Vec3& n) {
  std::vector<Vec3> points = core_points(solid);
  double front = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) front = std::max(front, glm::dot(p, n));
  std::erase_if(points, [&](const Vec3& p) { return glm::dot(p, n) < front - kFlat_m; });
  Vec3 middle(0.0);
  for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
  const Vec3 u = perpendicular(n), v = glm::cross(n, u);
  const auto angle = [&](const Vec3& p) { return det::atan2(glm::dot(p - middle, v), glm::dot(p - middle, u)); };
  std::ranges::sort(points, {}, angle);
  return points;
}

struct Pair {
  Vec3 on_a, on_b;
  double length() const { return contort::length(on_b - on_a); }
};

// Returns true if p is over the feature, whose corners go counter-clockwise around `around`.
bool is_over(const std::vector<Vec3>& feature, const Vec3& p, const Vec3& around) {
  for (std::size_t i = 0; i < feature.size(); ++i) {
    const Vec3& from = feature[i];
    const Vec3& to = feature[(i + 1) % feature.size()];
    if (glm::dot(glm::cross(to - from, p - from), around) < 0.0) return false;
  }
  return feature.size() > 2;
}

Segment edge_of(const std::vector<Vec3>& feature, std::size_t i) {
  return segment_between(feature[i], feature[(i + 1) % feature.size()]);
}

Pair nearest_of(const Segment& a, const Segment& b) {
  const ClosestOnSegments at = closest_on_segments(a, b);
  return {a.center + at.s * a.axis, b.center + at.t * b.axis};
}

// Returns true if the segments are not parallel. Parallel edges have many nearest points, and their end points cover
// these.
bool cross(const Segment& a, const Segment& b) {
  const Vec3 across = glm::cross(a.axis, b.axis);
  return a.half_length > 0.0 && b.half_length > 0.0 && glm::dot(across, across) > kNearlyParallel;
}

// `gap` is the distance of the features' planes along n, from a to b.
std::vector<Pair> candidates(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Vec3& n, double gap) {
  std::vector<Pair> pairs;
  for (const Vec3& p : a)
    if (is_over(b, p, -n)) pairs.push_back({p, p + gap * n});
  for (const Vec3& p : b)
    if (is_over(a, p, n)) pairs.push_back({p - gap * n, p});
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Segment of_a = edge_of(a, i), of_b = edge_of(b, j);
      pairs.push_back(nearest_of(segment_between(a[i], a[i]), of_b));
      pairs.push_back(nearest_of(of_a, segment_between(b[j], b[j])));
      if (cross(of_a, of_b)) pairs.push_back(nearest_of(of_a, of_b));
    }
  return pairs;
}

Pair middle_of_shortest(const std::vector<Pair>& pairs) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Pair& pair : pairs) shortest = std::min(shortest, pair.length());
  Pair sum{Vec3(0.0), Vec3(0.0)};
  double count = 0.0;
  for (const Pair& pair : pairs)
    if (pair.length() <= shortest + kEqual_m) sum.on_a += pair.on_a, sum.on_b += pair.on_b, count += 1.0;
  return {sum.on_a / count, sum.on_b / count};
}

}  // namespace

NearestPoints nearest_points(const Solid& a, const Solid& b) {
  NearestPoints nearest{a.center_m, b.center_m, signed_distance(a, b, kNoBand)};
  if (std::isnan(nearest.distance_m)) return nearest;
  const Vec3 n = direction_apart(a, b);
  Solid away = b;  // b moved along n, far enough that the cores neither overlap nor nearly touch
  const Vec3 shift = (kApart_m - (nearest.distance_m + a.radius_m + b.radius_m)) * n;
  away.center_m += shift;
  const Pair cores = middle_of_shortest(candidates(feature_ahead(a, n), feature_ahead(away, -n), n, kApart_m));
  nearest.on_a_m = cores.on_a + a.radius_m * n;
  nearest.on_b_m = cores.on_b - shift - b.radius_m * n;
  return nearest;
}

}  // namespace contort
