// Takes the jolts out of a target's joints. A limb that is kept clear of a body, or cut, stops within a frame; with
// mass it needs longer. There the motion is replaced by its mean over time, as wide as joints need it.
#pragma once

#include <span>

#include "model/motion/legs.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

// Changes joints that are of no leg; all by the same weights, so that hands stay at what they hold as nearly as they
// can. `easy`: easy_accelerations. A motion without jolts stays as it is, bit by bit. Answers whether it has changed.
bool soften_joints(const Character& character, std::span<const Leg> legs, std::span<const double> easy,
                   Motion& motion);

// Changes legs that are lifted, or come down, while all that carries them rests. Gaits have their own ways of feet.
void soften_legs(const Character& character, std::span<const Leg> legs, const Environment& environment,
                 std::span<const double> easy, Motion& motion);

}  // namespace contort
