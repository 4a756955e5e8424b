#include "model/core/math.h"

#include <cmath>

#include "model/core/detmath.h"

namespace contort {

Vec3 unit_or(const Vec3& v, const Vec3& fallback) {
  const double length = std::sqrt(glm::dot(v, v));
  return length > 1e-12 ? v / length : fallback;
}

Vec3 perpendicular(const Vec3& u) {
  // The cross product with the axis that is least aligned with u is well away from zero.
  const Vec3 a = glm::abs(u);
  const Vec3 helper = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0) : a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  return unit_or(glm::cross(u, helper), Vec3(1, 0, 0));
}

Quat axis_angle(const Vec3& axis, double angle_rad) {
  const det::SinCos half = det::sincos(0.5 * angle_rad);
  return Quat(half.cos, half.sin * axis.x, half.sin * axis.y, half.sin * axis.z);
}

Quat from_rotation_vector(const Vec3& rotation_rad) {
  const double angle = std::sqrt(glm::dot(rotation_rad, rotation_rad));
  if (angle < 1e-12) return kNoRotation;
  return axis_angle(rotation_rad / angle, angle);
}

Vec3 to_rotation_vector(const Quat& q) {
  const Vec3 v = q.w < 0.0 ? Vec3(-q.x, -q.y, -q.z) : Vec3(q.x, q.y, q.z);
  const double s = std::sqrt(glm::dot(v, v));
  if (s < 1e-12) return 2.0 * v;
  return v * (2.0 * det::atan2(s, std::fabs(q.w)) / s);
}

double rotation_angle(const Quat& q) {
  const double s = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  return 2.0 * det::atan2(s, std::fabs(q.w));
}

double angle_towards(const Vec3& axis, const Vec3& v, const Vec3& direction) {
  const double along = glm::dot(axis, v) * glm::dot(axis, direction);
  return det::atan2(glm::dot(axis, glm::cross(v, direction)), glm::dot(v, direction) - along);
}

Quat shortest_arc(const Vec3& from, const Vec3& to) {
  const double w = 1.0 + glm::dot(from, to);
  if (w < 1e-9) {
    // For nearly opposite vectors 1 + dot is too inexact. Half a turn to -from comes near enough to `to`.
    const Vec3 axis = perpendicular(from);
    return shortest_arc(-from, to) * Quat(0.0, axis.x, axis.y, axis.z);
  }
  const Vec3 v = glm::cross(from, to);
  return glm::normalize(Quat(w, v.x, v.y, v.z));
}

Quat slerp_short(const Quat& a, const Quat& b, double t) {
  const double dot = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
  const double sign = dot < 0.0 ? -1.0 : 1.0;
  double weight_a = 1.0 - t;
  double weight_b = t;
  if (sign * dot < 1.0 - 1e-9) {  // for smaller angles the chord equals the arc in double precision
    const double s = std::sqrt(1.0 - dot * dot);
    const double angle = det::atan2(s, sign * dot);
    weight_a = det::sin((1.0 - t) * angle) / s;
    weight_b = det::sin(t * angle) / s;
  }
  return glm::normalize(a * weight_a + b * (sign * weight_b));
}

}  // namespace contort
