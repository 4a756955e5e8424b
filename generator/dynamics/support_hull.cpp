#include "generator/dynamics/support_hull.h"

#include <algorithm>
#include <cmath>

#include "model/core/index.h"

namespace contort {

namespace {

// Twice the area of a triangle seen from above, > 0 counter-clockwise.
double area_above(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z);
}

double length_above(const Vec3& v) { return std::sqrt(v.x * v.x + v.z * v.z); }

// Returns the distance of p to the inside of the edge from a to b, seen from above.
double inside_by(const Vec3& a, const Vec3& b, const Vec3& p) { return area_above(a, b, p) / length_above(b - a); }

Vec3 nearest_on(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 way = b - a, to = p - a;
  const double square = way.x * way.x + way.z * way.z;
  const double share = square > 0.0 ? std::clamp((to.x * way.x + to.z * way.z) / square, 0.0, 1.0) : 0.0;
  return a + share * way;
}

// Leaves the part of a polygon that is at least `inset_m` inside of an edge (I. Sutherland and G. Hodgman, 1974).
void cut(const Vec3& a, const Vec3& b, double inset_m, std::vector<Vec3>& polygon, std::vector<Vec3>& left) {
  left.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double d0 = inside_by(a, b, from) - inset_m, d1 = inside_by(a, b, to) - inset_m;
    if (d0 >= 0.0) left.push_back(from);
    if ((d0 < 0.0) != (d1 < 0.0)) left.push_back(from + d0 / (d0 - d1) * (to - from));
  }
  polygon.swap(left);
}

// The hull's inset, in scratch.outline; empty where the hull is too narrow.
void inset(double inset_m, HullScratch& scratch) {
  const std::vector<Vec3>& hull = scratch.hull;
  scratch.outline.assign(hull.begin(), hull.end());
  for (std::size_t i = 0; i < hull.size() && !scratch.outline.empty(); ++i)
    cut(hull[i], hull[(i + 1) % hull.size()], inset_m, scratch.outline, scratch.cut);
}

Vec3 nearest_of_outline(const std::vector<Vec3>& outline, const Vec3& p) {
  Vec3 best = outline.front();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 point = nearest_on(outline[i], outline[(i + 1) % outline.size()], p);
    if (length_above(point - p) < length_above(best - p)) best = point;
  }
  return best;
}

bool is_inside(const std::vector<Vec3>& hull, double inset_m, const Vec3& p) {
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (inside_by(hull[i], hull[(i + 1) % hull.size()], p) < inset_m) return false;
  return hull.size() > 2;
}

}  // namespace

// A. M. Andrew's monotone chain (1979).
void convex_hull(std::vector<Vec3>& points, std::vector<int>& hull) {
  std::ranges::sort(points, [](const Vec3& a, const Vec3& b) { return a.z != b.z ? a.z < b.z : a.x < b.x; });
  hull.clear();
  const int count = static_cast<int>(points.size());
  const auto add = [&](int next, std::size_t kept) {
    while (hull.size() > kept &&
           area_above(points[at(hull[hull.size() - 2])], points[at(hull.back())], points[at(next)]) <= 0.0)
      hull.pop_back();
    hull.push_back(next);
  };
  for (int i = 0; i < count; ++i) add(i, 1);
  const std::size_t lower = hull.size();
  for (int i = count - 1; i-- > 0;) add(i, lower);
  if (hull.size() > 1) hull.pop_back();  // the first one again
}

Vec3 nearest_inside(std::vector<Vec3>& points, double inset_m, const Vec3& p, HullScratch& scratch) {
  convex_hull(points, scratch.order);
  scratch.hull.clear();
  for (const int i : scratch.order) scratch.hull.push_back(points[at(i)]);
  if (is_inside(scratch.hull, inset_m, p)) return p;
  scratch.outline.clear();
  for (double smaller = inset_m; scratch.outline.empty() && smaller > 0.1 * inset_m; smaller *= 0.5)
    inset(smaller, scratch);
  Vec3 best = nearest_of_outline(scratch.outline.empty() ? scratch.hull : scratch.outline, p);
  best.y = p.y;
  return best;
}

}  // namespace contort
