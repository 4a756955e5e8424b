// Makes a recorded motion one that a figure with mass can follow. The feet of recordings float, sink in, tilt and
// slide, and their joints tremble. Here noise is removed (low_pass.h), and each foot gets one place for each of its
// rests (foot_rests.h): there it lies flat on the ground, comes down on its heel and leaves over its toes. In the air
// it keeps its recorded path, with a correction that changes from one place to the next and agrees with both in speed
// and acceleration (compare L. Kovar, J. Schreiner and M. Gleicher, "Footskate cleanup for motion capture editing",
// SCA 2002). The root moves up or down with its feet, and goes down where a leg is too short.
#pragma once

#include <span>

#include "model/motion/legs.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

void plant_feet(const Character& character, std::span<const Leg> legs, const Environment& environment, Motion& motion);

}  // namespace contort
