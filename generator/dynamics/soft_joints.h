// Removes the jolts from a target's joints. A limb that is kept clear of a body, or cut, stops within a frame, but with
// mass it needs longer. There the motion is replaced by its mean over time, as wide as the joints need.
#pragma once

#include <span>

#include "model/motion/legs.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

// Changes joints outside of legs, all with the same weights, so that hands stay at their objects as nearly as possible.
// `easy`: easy_accelerations. A motion without jolts stays unchanged, bit by bit. Returns true if the motion has
// changed.
bool soften_joints(const Character& character, std::span<const Leg> legs, std::span<const double> easy,
                   Motion& motion);

// Changes legs that are lifted, or land, while all their carriers rest. Gaits have their own paths of feet.
void soften_legs(const Character& character, std::span<const Leg> legs, const Environment& environment,
                 std::span<const double> easy, Motion& motion);

}  // namespace contort
