// Solid shapes, for collisions and for drawing.
#pragma once

#include <variant>
#include <vector>

#include "model/core/math.h"

namespace contort {

struct Sphere {
  Vec3 center_m{0.0};
  double radius_m = 0.05;  // > 0
  bool operator==(const Sphere&) const = default;
};

struct Capsule {  // All points within radius_m of the segment a-b; a == b is a sphere.
  Vec3 a_m{0.0};
  Vec3 b_m{0.0};
  double radius_m = 0.05;  // > 0
  bool operator==(const Capsule&) const = default;
};

struct Box {
  Vec3 center_m{0.0};
  Vec3 half_m{0.05};       // Half of each side, along the box's own axes; each > 0.
  Vec3 rotation_deg{0.0};  // Rotation vector: axis times angle.
  bool operator==(const Box&) const = default;
};

inline constexpr int kMaxHullPoints = 64;

struct ConvexHull {  // The smallest convex solid that contains all points: 4 to kMaxHullPoints, not in one plane.
  std::vector<Vec3> points_m;
  bool operator==(const ConvexHull&) const = default;
};

struct TriangleMesh {  // Only drawn, never a collider.
  std::vector<Vec3> positions_m;
  std::vector<int> indices;  // Three to a triangle, counter-clockwise seen from outside.
  bool operator==(const TriangleMesh&) const = default;
};

using ColliderShape = std::variant<Sphere, Capsule, Box, ConvexHull>;
using MeshShape = std::variant<Sphere, Capsule, Box, ConvexHull, TriangleMesh>;

ColliderShape mirrored(const ColliderShape& shape);
MeshShape mirrored(const MeshShape& shape);

// Returns the same shape for drawing.
MeshShape as_mesh(const ColliderShape& shape);

// The shape's triangles, flat shaded: three consecutive entries are one triangle, each with its outward normal.
struct Triangles {
  std::vector<Vec3> positions_m;
  std::vector<Vec3> normals;
};
Triangles tessellate(const MeshShape& shape);

}  // namespace contort
