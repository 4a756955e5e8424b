// Removes the jolts from a target's legs that are lifted, or land, while all their carriers rest. Gaits have their own
// paths of feet.
//
// A mean over time is a shorter way than the motion itself, and may lead through the other leg. Where it does, the lift
// becomes smaller as a whole.
#pragma once

#include <span>

#include "generator/dynamics/figure.h"
#include "model/motion/legs.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

// `easy`: easy_accelerations.
void soften_legs(const Character& character, const DynamicFigure& figure, std::span<const Leg> legs,
                 const Environment& environment, std::span<const double> easy, Motion& motion);

}  // namespace contort
