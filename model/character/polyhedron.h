// The surface of a convex hull: corners, flat faces and edges, computed once when something is built.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "model/core/math.h"

namespace contort {

struct Polyhedron {
  struct Face {
    Vec3 normal;    // unit, outward
    int first = 0;  // its corners are loops[first .. first + count), counter-clockwise seen from outside
    int count = 0;
    bool operator==(const Face&) const = default;
  };
  struct Edge {
    std::array<int, 2> corners{};
    std::array<int, 2> faces{};
    bool operator==(const Edge&) const = default;
  };
  Vec3 center_m{0.0};           // the mean of the corners, which is inside
  std::vector<Vec3> corners_m;  // seen from the centre
  std::vector<Face> faces;
  std::vector<int> loops;
  std::vector<Edge> edges;

  const Vec3& corner_of(const Face& face, int i) const {
    return corners_m[static_cast<std::size_t>(loops[static_cast<std::size_t>(face.first + i)])];
  }
  bool operator==(const Polyhedron&) const = default;
};

// Returns the hull of the points. Points inside of the solid, of a face or of an edge are not corners. It has no faces
// if the points span no solid: fewer than four, or all in one plane within the precision of doubles. At most
// kMaxHullPoints points.
Polyhedron convex_polyhedron(std::span<const Vec3> points_m);

// Returns the reason why the points cannot be a ConvexHull; "" if they can.
std::string hull_fault(std::span<const Vec3> points_m);

Polyhedron moved(const Rigid& to_from_own, Polyhedron solid);
Polyhedron mirrored(Polyhedron solid);

// The nearest point of the surface, the outward normal there, and the signed distance of the query point: < 0 inside.
struct OnSurface {
  Vec3 point_m{0.0};
  Vec3 normal{0.0, 1.0, 0.0};
  double distance_m = 0.0;
};
OnSurface nearest_on(const Polyhedron& solid, const Vec3& point_m);

}  // namespace contort
