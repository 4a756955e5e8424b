// The types for space. Metres and radians; right-handed, +Y up, +Z forward, +X to the character's left (glTF).
// `world_from_hand` maps hand coordinates to world coordinates, so products read as a chain: world_from_hand =
// world_from_arm * arm_from_hand.
#pragma once

#include <cmath>
#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace contort {

using Vec3 = glm::dvec3;
using Quat = glm::dquat;  // Constructed as (w, x, y, z). Unit length if it is a rotation.
using Mat3 = glm::dmat3;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kRadPerDeg = kPi / 180.0;
inline constexpr double kDegPerRad = 180.0 / kPi;
inline const Quat kNoRotation{1.0, 0.0, 0.0, 0.0};

// A rotation followed by a translation: a_from_b(p) = q * p + p_m.
struct Rigid {
  Quat q = Quat(1.0, 0.0, 0.0, 0.0);
  Vec3 p_m = Vec3(0.0);
  bool operator==(const Rigid&) const = default;
};

inline Rigid operator*(const Rigid& a_from_b, const Rigid& b_from_c) {
  return {a_from_b.q * b_from_c.q, a_from_b.p_m + a_from_b.q * b_from_c.p_m};
}
[[gnu::always_inline]] inline Vec3 operator*(const Rigid& a_from_b, const Vec3& point_b) {
  return a_from_b.q * point_b + a_from_b.p_m;
}
inline Rigid inverse(const Rigid& a_from_b) {
  const Quat q = glm::conjugate(a_from_b.q);
  return {q, -(q * a_from_b.p_m)};
}

inline double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

// Reads a rotation from a row of coordinates: w, x, y, z.
inline Quat quat_at(const double* q) { return {q[0], q[1], q[2], q[3]}; }

// Returns the unit vector along v, or `fallback` if v is too short to have a direction (length below 1e-12).
Vec3 unit_or(const Vec3& v, const Vec3& fallback);

// Any unit vector at a right angle to the unit vector u; a continuous choice almost everywhere.
Vec3 perpendicular(const Vec3& u);

// Rotation by angle_rad about the unit vector `axis`, right-hand rule.
Quat axis_angle(const Vec3& axis, double angle_rad);

// Exponential map and its inverse. to_rotation_vector takes the short way: its length is in [0, pi].
Quat from_rotation_vector(const Vec3& rotation_rad);
Vec3 to_rotation_vector(const Quat& q);

// The angle of the rotation q, short way, in [0, pi].
double rotation_angle(const Quat& q);

// The angle about the unit vector `axis` that turns v as near as possible to `direction`, in [-pi, pi].
double angle_towards(const Vec3& axis, const Vec3& v, const Vec3& direction);

// The smallest rotation that turns unit vector `from` to unit vector `to`; half a turn about a fixed
// perpendicular when they are opposite.
Quat shortest_arc(const Vec3& from, const Vec3& to);

// Rises from 0 to 1 with no speed and no acceleration at both ends, as hands move from place to place (Flash and
// Hogan, The coordination of arm movements, J. Neurosci. 5, 1985); u in [0, 1].
inline double minimum_jerk(double u) { return u * u * u * (10.0 + u * (6.0 * u - 15.0)); }

// Spherical interpolation along the shorter arc; t in [0, 1].
Quat slerp_short(const Quat& a, const Quat& b, double t);

// The place at a share of the way between two places: along a straight line and the shorter arc.
inline Rigid part_way(const Rigid& from, const Rigid& to, double share) {
  return {slerp_short(from.q, to.q, share), from.p_m + share * (to.p_m - from.p_m)};
}

// Returns the nearest multiple of 1 / steps_per_unit. It divides, so that the result is the double with the shortest
// text.
inline double on_lattice(double value, double steps_per_unit) {
  return std::floor(value * steps_per_unit + 0.5) / steps_per_unit + 0.0;  // -0 becomes 0
}

// Returns the angle wrapped to [-pi, pi).
inline double wrap_angle(double angle) { return angle - 2.0 * kPi * std::floor((angle + kPi) / (2.0 * kPi)); }

// Reflects in the plane x = 0 (left and right change places). Rotations and axes are axial vectors: they keep x and
// negate y and z.
inline Vec3 mirror_point(const Vec3& p) { return {-p.x, p.y, p.z}; }
inline Vec3 mirror_axis(const Vec3& a) { return {a.x, -a.y, -a.z}; }
inline Quat mirror_rotation(const Quat& q) { return Quat(q.w, q.x, -q.y, -q.z); }

}  // namespace contort
