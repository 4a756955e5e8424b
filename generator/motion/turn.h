// Turning one joint about an axis in the world, as far as its own axes allow.
#pragma once

#include "model/character/character.h"
#include "model/motion/motion.h"

namespace contort {

// A ball turns by the whole angle, and a hinge by the angle times the cosine between the axes; prismatic joints do not
// move.
void turn_joint(const Joint& joint, const Quat& world_from_joint, const Vec3& axis_world, double angle_rad,
                Posture& posture);

}  // namespace contort
