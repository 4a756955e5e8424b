// Six-dimensional vectors of rigid-body dynamics, about a point and along the axes of a frame: R. Featherstone, "Rigid
// Body Dynamics Algorithms", 2008, chapter 2. The angular part comes first.
#pragma once

#include "model/core/math.h"

namespace contort {

// A vector with a fourth number, so that one instruction on four numbers reads and writes it. That number is finite and
// unused.
struct alignas(32) WideVec3 : Vec3 {
  WideVec3(const Vec3& v = Vec3(0.0)) : Vec3(v) {}
  const Vec3& narrow() const { return *this; }  // for templates that must deduce this type
  double fourth = 0.0;
};

// Columns of a matrix.
struct WideMat3 {
  WideVec3 columns[3];

  WideMat3(const Mat3& m = Mat3(0.0)) : columns{m[0], m[1], m[2]} {}
  operator Mat3() const { return {columns[0], columns[1], columns[2]}; }
  const WideVec3& operator[](int k) const { return columns[k]; }
  WideVec3& operator[](int k) { return columns[k]; }
};
inline Vec3 operator*(const WideMat3& m, const Vec3& v) { return v.x * m[0] + v.y * m[1] + v.z * m[2]; }

// A velocity or acceleration of a body: rad/s (rad/s^2), m/s (m/s^2) of the point of the body that is there.
struct SpatialMotion {
  WideVec3 angular;
  WideVec3 linear;
};

// A force or momentum: N m about the origin (N m s), N (N s).
struct SpatialForce {
  WideVec3 moment;
  WideVec3 force;
};

// Mass, first moment mass * centre (kg m), and inertia about the point (kg m^2), symmetric.
struct SpatialInertia {
  double mass_kg = 0.0;
  WideVec3 first_moment;
  WideMat3 inertia;
};

inline SpatialForce operator*(const SpatialInertia& i, const SpatialMotion& m) {
  return {i.inertia * m.angular + glm::cross(i.first_moment, m.linear),
          i.mass_kg * m.linear - glm::cross(i.first_moment, m.angular)};
}

inline SpatialMotion& operator+=(SpatialMotion& a, const SpatialMotion& b) {
  a.angular = a.angular + b.angular, a.linear = a.linear + b.linear;
  return a;
}
inline SpatialMotion operator*(double share, const SpatialMotion& m) { return {share * m.angular, share * m.linear}; }

inline SpatialForce& operator+=(SpatialForce& a, const SpatialForce& b) {
  a.moment = a.moment + b.moment, a.force = a.force + b.force;
  return a;
}

// The force for this motion of a body: I a + v x* I v, computed from the acceleration of its point at the origin.
inline SpatialForce force_of(const SpatialInertia& i, const SpatialMotion& v, const SpatialMotion& a) {
  const Vec3 origin_m_s2 = a.linear + glm::cross(v.angular, v.linear);
  return {
      i.inertia * a.angular + glm::cross(v.angular, i.inertia * v.angular) + glm::cross(i.first_moment, origin_m_s2),
      i.mass_kg * origin_m_s2 + glm::cross(a.angular, i.first_moment) +
          glm::cross(v.angular, glm::cross(v.angular, i.first_moment))};
}

// The power of a force on a body with this motion, W.
inline double dot(const SpatialMotion& m, const SpatialForce& f) {
  return glm::dot(m.angular.narrow(), f.moment.narrow()) + glm::dot(m.linear.narrow(), f.force.narrow());
}

// The velocity of a point of the moved body, at a place from the origin, m/s.
inline Vec3 point_velocity(const SpatialMotion& motion, const Vec3& from_origin_m) {
  return motion.linear + glm::cross(motion.angular, from_origin_m);
}

}  // namespace contort
