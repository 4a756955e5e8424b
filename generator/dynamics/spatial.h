// Six-dimensional vectors of rigid-body dynamics, about a point and along the axes of a frame: R. Featherstone, "Rigid
// Body Dynamics Algorithms", 2008, chapter 2. The angular part comes first.
#pragma once

#include "generator/core/math.h"

namespace contort {

// A velocity or acceleration of a body: rad/s (rad/s^2), m/s (m/s^2) of the point of the body that is there.
struct SpatialMotion {
  Vec3 angular{0.0};
  Vec3 linear{0.0};
};

// A force or momentum: N m about the origin (N m s), N (N s).
struct SpatialForce {
  Vec3 moment{0.0};
  Vec3 force{0.0};
};

// A symmetric matrix: its diagonal, and what stands beside it at yz, xz and xy.
struct SymmetricMatrix {
  Vec3 diagonal{0.0};
  Vec3 beside{0.0};
};

inline Vec3 operator*(const SymmetricMatrix& m, const Vec3& v) {
  return {m.diagonal.x * v.x + m.beside.z * v.y + m.beside.y * v.z,
          m.beside.z * v.x + m.diagonal.y * v.y + m.beside.x * v.z,
          m.beside.y * v.x + m.beside.x * v.y + m.diagonal.z * v.z};
}

// Mass, first moment mass * centre (kg m), and inertia about the point (kg m^2).
struct SpatialInertia {
  double mass_kg = 0.0;
  Vec3 first_moment{0.0};
  SymmetricMatrix inertia;
};

inline SpatialForce operator*(const SpatialInertia& i, const SpatialMotion& m) {
  return {i.inertia * m.angular + glm::cross(i.first_moment, m.linear),
          i.mass_kg * m.linear - glm::cross(i.first_moment, m.angular)};
}

inline SpatialMotion& operator+=(SpatialMotion& a, const SpatialMotion& b) {
  a.angular += b.angular, a.linear += b.linear;
  return a;
}
inline SpatialMotion operator+(const SpatialMotion& a, const SpatialMotion& b) {
  return {a.angular + b.angular, a.linear + b.linear};
}
inline SpatialMotion operator*(double share, const SpatialMotion& m) { return {share * m.angular, share * m.linear}; }

inline SpatialForce& operator+=(SpatialForce& a, const SpatialForce& b) {
  a.moment += b.moment, a.force += b.force;
  return a;
}

// What moves a body so: I a + v x* I v, by the shorter way of the acceleration of the body's point at the origin.
// Written in place, as copies through memory cost as much as the sums.
inline void put_force_of(const SpatialInertia& i, const SpatialMotion& v, const SpatialMotion& a, SpatialForce& out) {
  const Vec3 origin_m_s2 = a.linear + glm::cross(v.angular, v.linear);
  out.force = i.mass_kg * origin_m_s2 + glm::cross(a.angular, i.first_moment) +
              glm::cross(v.angular, glm::cross(v.angular, i.first_moment));
  out.moment =
      i.inertia * a.angular + glm::cross(v.angular, i.inertia * v.angular) + glm::cross(i.first_moment, origin_m_s2);
}

inline SpatialForce force_of(const SpatialInertia& inertia, const SpatialMotion& v, const SpatialMotion& a) {
  SpatialForce force;
  put_force_of(inertia, v, a, force);
  return force;
}

inline SpatialInertia& operator+=(SpatialInertia& a, const SpatialInertia& b) {
  a.mass_kg += b.mass_kg, a.first_moment += b.first_moment;
  a.inertia.diagonal += b.inertia.diagonal, a.inertia.beside += b.inertia.beside;
  return a;
}

// The power of a force on a body that moves so, W.
inline double dot(const SpatialMotion& m, const SpatialForce& f) {
  return glm::dot(m.angular, f.moment) + glm::dot(m.linear, f.force);
}

// v x m: how a motion that is carried along with v changes.
inline SpatialMotion cross_motion(const SpatialMotion& v, const SpatialMotion& m) {
  return {glm::cross(v.angular, m.angular), glm::cross(v.angular, m.linear) + glm::cross(v.linear, m.angular)};
}

}  // namespace contort
