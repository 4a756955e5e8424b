// Converts between rates of a rotation vector and angular velocities along the axes of the rotated body: the right
// Jacobian of the exponential map and its inverse (J. Sola et al., "A micro Lie theory for state estimation in
// robotics", 2018, equations 143 and 144).
#pragma once

#include "model/core/math.h"

namespace contort {

// d(rotation vector)/dt from the angular velocity, for rotations below a full turn.
Vec3 rotation_vector_rate(const Vec3& rotation, const Vec3& angular_velocity);

// The inverse.
Vec3 angular_velocity_of(const Vec3& rotation, const Vec3& rotation_rate);

}  // namespace contort
