// Measures the distance of a joint between two poses. The checks that judge the motion of joints share it.
#pragma once

#include "checks/check.h"
#include "model/character/character.h"

namespace contort {

// The distance between two poses, which are whole rows of coordinates. For a hinge it is the angle between them, rad;
// for a ball the angle of the rotation between them on the shorter way, so that the sign of a quaternion does not
// matter; for a prismatic joint metres.
double joint_step(const Joint& joint, const double* before, const double* now);

// The distance with its direction in the joint's frame: (x, 0, 0) for a hinge or prismatic joint, a rotation vector
// for a ball.
Vec3 joint_step_vector(const Joint& joint, const double* before, const double* now);

// The distance in a unit that is comparable between joints of all kinds: metres count ten times, because 1 cm is
// about as visible as 0.1 rad.
double likeness_rad(const Joint& joint, const double* before, const double* now);

// Returns the unit of a joint's coordinate, "rad" or "m", followed by `ending`: "rad/s".
std::string_view unit_of(const Joint& joint, std::string_view angular, std::string_view linear);

// The subjects of checks that judge every joint but the root: subject i is joint i + 1.
int moving_joint_count(const Character& character);
Subject moving_joint(const Character& character, int subject, std::string_view angular, std::string_view linear);

}  // namespace contort
