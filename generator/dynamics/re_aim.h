// Aims of a target whose hips were moved: hips that sway by a few centimetres turn a point away from its target by more
// than aims tolerate.
#pragma once

#include <span>

#include "model/motion/legs.h"
#include "model/motion/motion.h"

namespace contort {

// Turns the hinges of the aiming parts, in the frames of Motion::aims, so that they point at their targets again as far
// as ranges allow, by a few degrees at most. Before and after these frames the turns fade. Parts that carry legs stay
// unchanged.
void re_aim(const Character& character, std::span<const Leg> legs, Motion& motion);

}  // namespace contort
