// Euler angles about the axes of hinges at one point, as in a hip.
#pragma once

#include "model/core/math.h"

namespace contort {

// Returns the coordinates of three successive hinges with axes at right angles that give the rotation (Euler angles
// about the hinges' own axes; the middle one in [-pi/2, pi/2]).
Vec3 hinge_angles(const Vec3& first_axis, const Vec3& second_axis, const Vec3& third_axis, const Quat& rotation);

}  // namespace contort
