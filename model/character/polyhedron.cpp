#include "model/character/polyhedron.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>

#include "model/character/shape.h"
#include "model/core/assert.h"
#include "model/core/index.h"
#include "model/core/math.h"

namespace contort {

namespace {

using Mask = std::uint64_t;  // set of points
static_assert(kMaxHullPoints <= 64);

bool has(Mask mask, std::size_t i) { return (mask >> i & 1) != 0; }

// The greatest difference of a coordinate between two points.
double extent_of(std::span<const Vec3> points) {
  Vec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const Vec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

std::vector<Vec3> without_repeats(std::span<const Vec3> points, double tolerance) {
  std::vector<Vec3> kept;
  for (const Vec3& p : points)
    if (std::none_of(kept.begin(), kept.end(), [&](const Vec3& k) { return length(p - k) <= tolerance; }))
      kept.push_back(p);
  return kept;
}

// A plane with all points on it or behind it, and the set of points on it.
struct Facet {
  Vec3 normal{0.0};
  Mask on = 0;
};

// The plane through a point, at a right angle to `across`, if all other points are on one side of it or on it;
// otherwise on = 0.
Facet facet_across(std::span<const Vec3> points, const Vec3& through, const Vec3& across, double tolerance) {
  const Vec3 normal = across / length(across);
  Mask on = 0;
  bool before = false, behind = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double height = glm::dot(normal, points[i] - through);
    before |= height > tolerance, behind |= height < -tolerance;
    if (before && behind) return {};
    if (std::fabs(height) <= tolerance) on |= Mask{1} << i;
  }
  if (before == behind) return {};  // all points are in the plane
  return {before ? -normal : normal, on};
}

// Tries every three points, which is simple and fast enough for few points. Slivers are skipped, because they do not
// define their plane well.
std::vector<Facet> facets_of(std::span<const Vec3> points, double tolerance, double sliver) {
  std::vector<Facet> facets;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        const Vec3 across = glm::cross(points[j] - points[i], points[k] - points[i]);
        if (glm::dot(across, across) <= sliver * sliver) continue;
        Facet facet = facet_across(points, points[i], across, tolerance);
        if (facet.on == 0) continue;
        facet.on |= Mask{1} << i | Mask{1} << j | Mask{1} << k;
        if (std::any_of(facets.begin(), facets.end(), [&](const Facet& f) { return (f.on & facet.on) == facet.on; }))
          continue;
        std::erase_if(facets, [&](const Facet& f) { return (f.on & facet.on) == f.on; });
        facets.push_back(facet);
      }
  return facets;
}

// The corners of a facet, counter-clockwise seen from outside. Begins at the corner that is farthest from the middle.
// The next corner is always the point that has all others on its left.
std::vector<int> loop_of(std::span<const Vec3> points, const Facet& facet, double tolerance) {
  std::vector<std::size_t> on;
  Vec3 sum(0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (has(facet.on, i)) on.push_back(i), sum += points[i];
  const Vec3 middle = sum / static_cast<double>(on.size());
  const std::size_t start = *std::max_element(on.begin(), on.end(), [&](std::size_t l, std::size_t r) {
    return length(points[l] - middle) < length(points[r] - middle);
  });
  std::vector<int> loop;
  for (std::size_t here = start; loop.size() <= on.size();) {
    loop.push_back(static_cast<int>(here));
    std::size_t next = here;
    for (const std::size_t i : on) {
      if (i == here) continue;
      const Vec3 step = points[next] - points[here], other = points[i] - points[here];
      // The distance of `other` to the right of the line to `next`.
      const double right = next == here ? 1.0 : -glm::dot(glm::cross(step, other), facet.normal) / length(step);
      const bool farther = glm::dot(other, other) > glm::dot(step, step);
      if (next == here || right > tolerance || (right > -tolerance && farther && glm::dot(other, step) > 0.0)) next = i;
    }
    if (next == start) return loop;
    here = next;
  }
  return {};  // the loop did not close
}

void add_faces(std::span<const Vec3> points, const std::vector<Facet>& facets, double tolerance, Polyhedron& out) {
  for (const Facet& facet : facets) {
    const std::vector<int> loop = loop_of(points, facet, tolerance);
    out.faces.push_back({facet.normal, static_cast<int>(out.loops.size()), static_cast<int>(loop.size())});
    out.loops.insert(out.loops.end(), loop.begin(), loop.end());
  }
}

// Finds edges by their two faces. Returns false if the faces do not form a closed surface.
bool add_edges(Polyhedron& out) {
  std::map<std::pair<int, int>, int> face_of;  // by the edge, in the direction of the face's loop
  for (std::size_t f = 0; f < out.faces.size(); ++f) {
    const Polyhedron::Face& face = out.faces[f];
    for (int i = 0; i < face.count; ++i) {
      const int a = out.loops[at(face.first + i)], b = out.loops[at(face.first + (i + 1) % face.count)];
      if (!face_of.emplace(std::pair(a, b), static_cast<int>(f)).second) return false;
    }
  }
  for (const auto& [edge, face] : face_of) {
    const auto other = face_of.find({edge.second, edge.first});
    if (other == face_of.end()) return false;
    if (edge.first < edge.second) out.edges.push_back({{edge.first, edge.second}, {face, other->second}});
  }
  return true;
}

// Keeps only the points that are corners, relative to their mean.
void add_corners(std::span<const Vec3> points, Polyhedron& out) {
  std::vector<int> index(points.size(), -1);
  for (const int i : out.loops) index[at(i)] = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (index[i] == 0) {
      index[i] = static_cast<int>(out.corners_m.size());
      out.corners_m.push_back(points[i]);
    }
  for (int& i : out.loops) i = index[at(i)];
  for (Polyhedron::Edge& edge : out.edges)
    for (int& i : edge.corners) i = index[at(i)];
  for (const Vec3& corner : out.corners_m) out.center_m += corner / static_cast<double>(out.corners_m.size());
  for (Vec3& corner : out.corners_m) corner -= out.center_m;
}

// Checks by Euler's formula that corners, edges and faces form one closed surface.
bool is_closed(const Polyhedron& p) {
  return p.faces.size() >= 4 && p.corners_m.size() + p.faces.size() == p.edges.size() + 2;
}

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 along = b - a;
  return a + std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0) * along;
}

// The point of a face that is nearest to p, which lies in front of its plane by `height`.
Vec3 nearest_on_face(const Polyhedron& solid, const Polyhedron::Face& face, const Vec3& p, double height) {
  const Vec3 foot = p - height * face.normal;
  bool inside = true;
  double least = std::numeric_limits<double>::infinity();
  Vec3 best = foot;
  for (int i = 0; i < face.count; ++i) {
    const Vec3 &a = solid.corner_of(face, i), &b = solid.corner_of(face, (i + 1) % face.count);
    inside &= glm::dot(glm::cross(b - a, foot - a), face.normal) >= 0.0;
    const Vec3 on = nearest_on_segment(a, b, p);
    if (const double d = length(p - on); d < least) least = d, best = on;
  }
  return inside ? foot : best;
}

}  // namespace

Polyhedron convex_polyhedron(std::span<const Vec3> points_m) {
  CONTORT_ASSERT(points_m.size() <= at(kMaxHullPoints));
  const double extent = extent_of(points_m);
  const std::vector<Vec3> points = without_repeats(points_m, 1e-12 * extent);
  if (points.size() < 4) return {};
  // Any three points of a facet must give the same plane. If they do not, a wider tolerance is tried.
  for (double tolerance = 1e-12; tolerance < 2e-9; tolerance *= 10.0) {
    Polyhedron out;
    // Rounding tilts the plane of a smaller triangle too much.
    const double sliver = 1e-15 / tolerance * extent * extent;
    const std::vector<Facet> facets = facets_of(points, tolerance * extent, sliver);
    add_faces(points, facets, tolerance * extent, out);
    if (!add_edges(out)) continue;
    add_corners(points, out);
    if (is_closed(out)) return out;
  }
  return {};
}

std::string hull_fault(std::span<const Vec3> points_m) {
  if (points_m.size() < 4 || points_m.size() > at(kMaxHullPoints))
    return "found " + std::to_string(points_m.size()) + " points, a hull needs 4 to " + std::to_string(kMaxHullPoints);
  for (const Vec3& p : points_m)
    if (!std::isfinite(p.x + p.y + p.z)) return "a point is not finite";
  if (convex_polyhedron(points_m).faces.empty()) return "the points are in one plane, or too nearly so";
  return "";
}

Polyhedron moved(const Rigid& to_from_own, Polyhedron solid) {
  solid.center_m = to_from_own * solid.center_m;
  for (Vec3& corner : solid.corners_m) corner = to_from_own.q * corner;
  for (Polyhedron::Face& face : solid.faces) face.normal = to_from_own.q * face.normal;
  return solid;
}

Polyhedron mirrored(Polyhedron solid) {
  solid.center_m = mirror_point(solid.center_m);
  for (Vec3& corner : solid.corners_m) corner = mirror_point(corner);
  for (Polyhedron::Face& face : solid.faces) {
    face.normal = mirror_point(face.normal);
    std::reverse(solid.loops.begin() + face.first, solid.loops.begin() + face.first + face.count);
  }
  return solid;
}

OnSurface nearest_on(const Polyhedron& solid, const Vec3& point_m) {
  const Vec3 p = point_m - solid.center_m;
  OnSurface best{point_m, {0, 1, 0}, -std::numeric_limits<double>::infinity()};
  double least = std::numeric_limits<double>::infinity();
  bool outside = false;
  for (const Polyhedron::Face& face : solid.faces) {
    const double height = glm::dot(face.normal, p - solid.corner_of(face, 0));
    if (height > 0.0) {
      outside = true;
      const Vec3 on = nearest_on_face(solid, face, p, height);
      const double distance = length(p - on);
      if (distance < least) least = distance, best = {solid.center_m + on, unit_or(p - on, face.normal), distance};
    } else if (!outside && height > best.distance_m) {
      best = {point_m - height * face.normal, face.normal, height};
    }
  }
  return best;
}

}  // namespace contort
