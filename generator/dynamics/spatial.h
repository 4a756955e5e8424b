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

// Mass, first moment mass * centre (kg m), and inertia about the point (kg m^2).
struct SpatialInertia {
  double mass_kg = 0.0;
  Vec3 first_moment{0.0};
  Mat3 inertia{0.0};
};

inline SpatialForce operator*(const SpatialInertia& i, const SpatialMotion& m) {
  return {i.inertia * m.angular + glm::cross(i.first_moment, m.linear),
          i.mass_kg * m.linear - glm::cross(i.first_moment, m.angular)};
}

inline SpatialMotion& operator+=(SpatialMotion& a, const SpatialMotion& b) {
  a.angular += b.angular, a.linear += b.linear;
  return a;
}
inline SpatialMotion operator*(double share, const SpatialMotion& m) { return {share * m.angular, share * m.linear}; }

inline SpatialForce& operator+=(SpatialForce& a, const SpatialForce& b) {
  a.moment += b.moment, a.force += b.force;
  return a;
}

// v x* f: how a force that moves along with v changes.
inline SpatialForce cross_force(const SpatialMotion& v, const SpatialForce& f) {
  return {glm::cross(v.angular, f.moment) + glm::cross(v.linear, f.force), glm::cross(v.angular, f.force)};
}

// What moves a body so: I a + v x* I v.
inline SpatialForce force_of(const SpatialInertia& inertia, const SpatialMotion& v, const SpatialMotion& a) {
  SpatialForce force = inertia * a;
  force += cross_force(v, inertia * v);
  return force;
}

inline SpatialInertia& operator+=(SpatialInertia& a, const SpatialInertia& b) {
  a.mass_kg += b.mass_kg, a.first_moment += b.first_moment, a.inertia += b.inertia;
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
