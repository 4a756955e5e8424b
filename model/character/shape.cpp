#include "model/character/shape.h"

#include <array>

#include "model/character/polyhedron.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr int kRings = 5;      // rings of a hemisphere
constexpr int kSegments = 16;  // segments around the axis

Sphere mirror(const Sphere& s) { return {mirror_point(s.center_m), s.radius_m}; }
Capsule mirror(const Capsule& c) { return {mirror_point(c.a_m), mirror_point(c.b_m), c.radius_m}; }
Box mirror(const Box& b) { return {mirror_point(b.center_m), b.half_m, mirror_axis(b.rotation_deg)}; }
ConvexHull mirror(ConvexHull hull) {
  for (Vec3& p : hull.points_m) p = mirror_point(p);
  return hull;
}
TriangleMesh mirror(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions_m) p = mirror_point(p);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  return mesh;
}

void add_triangle(Triangles& out, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 cross = glm::cross(b - a, c - a);
  if (glm::dot(cross, cross) < 1e-20) return;  // a sliver at a pole
  const Vec3 normal = unit_or(cross, Vec3(0, 1, 0));
  for (const Vec3& p : {a, b, c}) {
    out.positions_m.push_back(p);
    out.normals.push_back(normal);
  }
}

void add_quad(Triangles& out, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  add_triangle(out, a, b, c);
  add_triangle(out, a, c, d);
}

// Sines and cosines of all rings and segments, computed once because each corner of a capsule needs two of them.
struct CapsuleAngles {
  std::array<det::SinCos, 2 * kRings - 1> tilts;
  std::array<det::SinCos, kSegments> turns;
};

const CapsuleAngles& capsule_angles() {
  static const CapsuleAngles angles = [] {
    CapsuleAngles made;
    for (int step = 0; step < 2 * kRings - 1; ++step)
      made.tilts[static_cast<std::size_t>(step)] = det::sincos(kPi * step / (2 * kRings - 2) - kPi / 2);
    for (int segment = 0; segment < kSegments; ++segment)
      made.turns[static_cast<std::size_t>(segment)] = det::sincos(2 * kPi * segment / kSegments);
    return made;
  }();
  return angles;
}

// A capsule as rings of latitude. The normals of rings are exact, so that it looks round.
Triangles tessellate_capsule(const Capsule& c) {
  const CapsuleAngles& angles = capsule_angles();
  const Vec3 up = unit_or(c.b_m - c.a_m, Vec3(0, 1, 0));
  const Vec3 side = perpendicular(up);
  const Vec3 front = glm::cross(side, up);
  const auto normal = [&](int ring, int segment) {
    const int step = ring < kRings ? ring : ring - 1;  // the two rings at the equator have the same normals
    const det::SinCos& tilt = angles.tilts[static_cast<std::size_t>(step)];
    const det::SinCos& turn = angles.turns[static_cast<std::size_t>(segment % kSegments)];
    return tilt.sin * up + tilt.cos * (turn.cos * side + turn.sin * front);
  };
  const auto point = [&](int ring, int segment) {
    return (ring < kRings ? c.a_m : c.b_m) + c.radius_m * normal(ring, segment);
  };
  Triangles out;
  for (int ring = 0; ring + 1 < 2 * kRings; ++ring)
    for (int s = 0; s < kSegments; ++s) {
      const std::size_t first = out.positions_m.size();
      const int corners[4][2] = {{ring, s}, {ring + 1, s}, {ring + 1, s + 1}, {ring, s + 1}};
      add_quad(out, point(corners[0][0], corners[0][1]), point(corners[1][0], corners[1][1]),
               point(corners[2][0], corners[2][1]), point(corners[3][0], corners[3][1]));
      for (std::size_t i = first; i < out.positions_m.size(); ++i) {
        const Vec3 from_axis = out.positions_m[i] - (ring < kRings ? c.a_m : c.b_m);
        const bool barrel = ring == kRings - 1;
        out.normals[i] = unit_or(barrel ? from_axis - glm::dot(from_axis, up) * up : from_axis, out.normals[i]);
      }
    }
  return out;
}

Triangles tessellate_box(const Box& b) {
  const Quat q = from_rotation_vector(b.rotation_deg * kRadPerDeg);
  const auto corner = [&](double x, double y, double z) { return b.center_m + q * (Vec3(x, y, z) * b.half_m); };
  Triangles out;
  for (const double s : {-1.0, 1.0}) {  // s flips both the face and its winding
    add_quad(out, corner(s, -1, -s), corner(s, 1, -s), corner(s, 1, s), corner(s, -1, s));
    add_quad(out, corner(-s, s, -1), corner(-s, s, 1), corner(s, s, 1), corner(s, s, -1));
    add_quad(out, corner(-1, -s, s), corner(1, -s, s), corner(1, s, s), corner(-1, s, s));
  }
  return out;
}

Triangles tessellate_hull(const ConvexHull& hull) {
  const Polyhedron solid = convex_polyhedron(hull.points_m);
  Triangles out;
  for (const Polyhedron::Face& face : solid.faces) {
    const auto corner = [&](int i) { return solid.center_m + solid.corner_of(face, i); };
    for (int i = 1; i + 1 < face.count; ++i) add_triangle(out, corner(0), corner(i), corner(i + 1));
  }
  return out;
}

Triangles tessellate_mesh(const TriangleMesh& mesh) {
  Triangles out;
  const auto vertex = [&](std::size_t i) { return mesh.positions_m[static_cast<std::size_t>(mesh.indices[i])]; };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    add_triangle(out, vertex(i), vertex(i + 1), vertex(i + 2));
  return out;
}

struct Tessellate {
  Triangles operator()(const Sphere& s) const { return tessellate_capsule({s.center_m, s.center_m, s.radius_m}); }
  Triangles operator()(const Capsule& c) const { return tessellate_capsule(c); }
  Triangles operator()(const Box& b) const { return tessellate_box(b); }
  Triangles operator()(const ConvexHull& hull) const { return tessellate_hull(hull); }
  Triangles operator()(const TriangleMesh& mesh) const { return tessellate_mesh(mesh); }
};

}  // namespace

ColliderShape mirrored(const ColliderShape& shape) {
  return std::visit([](const auto& s) -> ColliderShape { return mirror(s); }, shape);
}

MeshShape mirrored(const MeshShape& shape) {
  return std::visit([](const auto& s) -> MeshShape { return mirror(s); }, shape);
}

MeshShape as_mesh(const ColliderShape& shape) {
  return std::visit([](const auto& s) { return MeshShape(s); }, shape);
}

Triangles tessellate(const MeshShape& shape) { return std::visit(Tessellate{}, shape); }

}  // namespace contort
