// Removes the jolts from a target's joints. A limb that is kept clear of a body, or cut, stops within a frame, but with
// mass it needs longer. There the motion is replaced by its mean over time, as wide as the joints need.
#pragma once

#include <span>
#include <vector>

#include "model/motion/legs.h"
#include "model/motion/motion.h"

namespace contort {

// The longest reach of a mean to either side.
constexpr double kWidestMean_s = 0.35;

// Changes these joints in the frames where `may` is not 0, and less near to others. `easy`: easy_accelerations; more than `jolt` times as much is
// a jolt. A motion without jolts stays unchanged, bit by bit. A motion that jolts at its beginning starts later, at
// rest, and catches up. Returns true if the motion has changed.
bool soften_joints(const Character& character, std::vector<int> joints, double jolt, std::span<const double> easy,
                   std::vector<char> may, Motion& motion);

// Changes joints outside of legs, all with the same weights, so that hands stay at their objects as nearly as possible.
bool soften_joints(const Character& character, std::span<const Leg> legs, std::span<const double> easy,
                   Motion& motion);

}  // namespace contort
