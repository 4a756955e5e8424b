#include "renders/wires.h"

#include "model/character/polyhedron.h"
#include "model/core/detmath.h"

namespace contort {
namespace {

constexpr int kWireSides = 3;  // sides of a wire's cross-section: a wire is a pixel or two wide
constexpr int kBends = 24;     // segments of a circle

class Wires {
 public:
  explicit Wires(double radius_m) : radius_m_(radius_m) {}

  void add_line(const Vec3& from, const Vec3& to) {
    const Vec3 along = unit_or(to - from, Vec3(0.0));
    if (along == Vec3(0.0)) return;
    const Vec3 u = perpendicular(along), v = glm::cross(along, u);
    for (int side = 0; side < kWireSides; ++side) {
      const Vec3 a = around(u, v, side), b = around(u, v, side + 1);
      add_corners({from + radius_m_ * a, from + radius_m_ * b, to + radius_m_ * b}, {a, b, b});
      add_corners({from + radius_m_ * a, to + radius_m_ * b, to + radius_m_ * a}, {a, b, a});
    }
  }

  // Adds the segments [first, last] of the circle that starts along u and continues towards v. Both vectors have the
  // circle's radius as length.
  void add_arc(const Vec3& center, const Vec3& u, const Vec3& v, int first, int last) {
    const auto point = [&](int bend) {
      const det::SinCos turn = det::sincos(2.0 * kPi * bend / kBends);
      return center + turn.cos * u + turn.sin * v;
    };
    for (int bend = first; bend < last; ++bend) add_line(point(bend), point(bend + 1));
  }
  void add_circle(const Vec3& center, const Vec3& u, const Vec3& v) { add_arc(center, u, v, 0, kBends); }

  Triangles triangles() && { return std::move(triangles_); }

 private:
  static Vec3 around(const Vec3& u, const Vec3& v, int side) {
    const det::SinCos turn = det::sincos(2.0 * kPi * (side % kWireSides) / kWireSides);
    return turn.cos * u + turn.sin * v;
  }
  void add_corners(std::initializer_list<Vec3> positions_m, std::initializer_list<Vec3> normals) {
    triangles_.positions_m.insert(triangles_.positions_m.end(), positions_m);
    triangles_.normals.insert(triangles_.normals.end(), normals);
  }

  double radius_m_;
  Triangles triangles_;
};

void add_wires(const Sphere& s, Wires& wires) {
  const Vec3 x(s.radius_m, 0, 0), y(0, s.radius_m, 0), z(0, 0, s.radius_m);
  wires.add_circle(s.center_m, x, y);
  wires.add_circle(s.center_m, y, z);
  wires.add_circle(s.center_m, z, x);
}

void add_wires(const Capsule& c, Wires& wires) {
  if (c.a_m == c.b_m) return add_wires(Sphere{c.a_m, c.radius_m}, wires);
  const Vec3 up = unit_or(c.b_m - c.a_m, Vec3(0, 1, 0)) * c.radius_m;
  const Vec3 side = perpendicular(unit_or(up, Vec3(0, 1, 0))) * c.radius_m, front = glm::cross(up, side) / c.radius_m;
  for (const Vec3& end : {c.a_m, c.b_m}) wires.add_circle(end, side, front);
  for (const Vec3& across : {side, front}) {
    for (const double sign : {1.0, -1.0}) wires.add_line(c.a_m + sign * across, c.b_m + sign * across);
    wires.add_arc(c.a_m, across, -up, 0, kBends / 2);
    wires.add_arc(c.b_m, across, up, 0, kBends / 2);
  }
}

void add_wires(const Box& b, Wires& wires) {
  const Quat q = from_rotation_vector(b.rotation_deg * kRadPerDeg);
  for (int axis = 0; axis < 3; ++axis)
    for (const double s : {-1.0, 1.0})
      for (const double t : {-1.0, 1.0}) {
        Vec3 from = b.half_m, to = b.half_m;
        from[axis] *= -1.0;
        for (Vec3* end : {&from, &to}) (*end)[(axis + 1) % 3] *= s, (*end)[(axis + 2) % 3] *= t;
        wires.add_line(b.center_m + q * from, b.center_m + q * to);
      }
}

void add_wires(const ConvexHull& hull, Wires& wires) {
  const Polyhedron solid = convex_polyhedron(hull.points_m);
  const auto corner = [&](int i) { return solid.center_m + solid.corners_m[static_cast<std::size_t>(i)]; };
  for (const Polyhedron::Edge& edge : solid.edges) wires.add_line(corner(edge.corners[0]), corner(edge.corners[1]));
}

}  // namespace

Triangles wire_triangles(const ColliderShape& shape, double radius_m) {
  Wires wires(radius_m);
  std::visit([&](const auto& s) { add_wires(s, wires); }, shape);
  return std::move(wires).triangles();
}

}  // namespace contort
