// Aims of a target whose hips have been moved: hips that sway by a few centimetres take a point off its target by more
// than an aim may miss it.
#pragma once

#include <span>

#include "model/motion/legs.h"
#include "model/motion/motion.h"

namespace contort {

// Turns the hinges of the parts that aim, in the frames of Motion::aims, so that they point at their targets again as far
// as ranges allow, by a few degrees at most. Beside these frames the turns fade. Parts that carry legs stay as they are.
void re_aim(const Character& character, std::span<const Leg> legs, Motion& motion);

}  // namespace contort
