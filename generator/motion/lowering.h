// Lowers a figure where its legs are too short for the places of its soles.
#pragma once

#include <span>

#include "model/motion/legs.h"
#include "model/motion/motion.h"

namespace contort {

// Returns by how much the hip must go down so that the leg, stretched to this share of its length, reaches the sole;
// at least 0.
double too_high_m(const Leg& leg, const Vec3& hip_m, const Rigid& world_from_sole, double stretch);

// Lowers the root around frames in which it is too high (`missing_m`, by frame), softly, by at most 3 cm at once.
// Returns true if there was such a frame.
bool lower_softly(std::span<const double> missing_m, Motion& motion);

}  // namespace contort
