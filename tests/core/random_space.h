// Points, directions and rotations for property tests, on lattices so that counterexamples are short.
#pragma once

#include <rapidcheck.h>

#include <cmath>

#include "model/core/math.h"

namespace contort::fixtures {

inline double lattice_number(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6;
}

inline Vec3 any_vec(double size) {
  return {lattice_number(-size, size), lattice_number(-size, size), lattice_number(-size, size)};
}

inline Vec3 any_unit() { return unit_or(any_vec(1.0), Vec3(0, 0, 1)); }

inline Quat any_quat() {
  const Quat q(lattice_number(-1, 1), lattice_number(-1, 1), lattice_number(-1, 1), lattice_number(-1, 1));
  return glm::dot(q, q) < 1e-6 ? kNoRotation : glm::normalize(q);
}

inline Rigid any_rigid(double size_m) { return {any_quat(), any_vec(size_m)}; }

// Angle of the rotation between two rotations, by the vector part: exact to double precision for small angles too.
inline double difference(const Quat& a, const Quat& b) { return rotation_angle(glm::conjugate(a) * b); }

}  // namespace contort::fixtures
