// The distance of a joint between two poses. Shared by the checks that judge motion of joints.
#pragma once

#include "checks/check.h"
#include "model/character/character.h"

namespace contort {

// rad: the angle between two coordinates of a hinge, for a ball that of the rotation between them, the short way, so
// that the sign of a quaternion does not matter; metres for a prismatic joint. Poses are whole rows of coordinates.
double joint_step(const Joint& joint, const double* before, const double* now);

// The same with its direction in the joint's frame: (x, 0, 0) for a hinge or prismatic joint, a rotation vector for a
// ball.
Vec3 joint_step_vector(const Joint& joint, const double* before, const double* now);

// Makes joints of all kinds comparable: metres count ten times, as 1 cm is about as plain to see as 0.1 rad.
double likeness_rad(const Joint& joint, const double* before, const double* now);

// "rad/s" or "m/s", and so on: the unit of a joint's coordinate with this ending.
std::string_view unit_of(const Joint& joint, std::string_view angular, std::string_view linear);

// The subjects of checks that judge every joint but the root: subject i is joint i + 1.
int moving_joint_count(const Character& character);
Subject moving_joint(const Character& character, int subject, std::string_view angular, std::string_view linear);

}  // namespace contort
