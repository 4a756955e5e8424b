// Aims of a target whose hips have been moved: hips that sway by a few centimetres take a point off its target by more
// than an aim may miss it. A figure that follows a target also lags where joints get faster or slower.
#pragma once

#include <span>

#include "model/motion/legs.h"
#include "model/motion/motion.h"

namespace contort {

// Turns hinges and balls of the parts that aim, in the frames of Motion::aims, so that a figure that follows them
// points at their targets as far as ranges allow, by a few degrees at most. Beside these frames the turns fade. Parts
// that carry legs stay as they are. `missed`: missed_of_bend (tracker.h).
void re_aim(const Character& character, std::span<const Leg> legs, double missed, Motion& motion);

}  // namespace contort
