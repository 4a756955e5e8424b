// Postures, part by part: hinges and travels blend linearly, balls and the root's rotation along the shorter arc, the
// root's place linearly. The root belongs to the first part.
#pragma once

#include "model/character/character.h"
#include "model/motion/motion.h"

namespace contort {

void copy_part(const Character& character, std::size_t part, const Posture& from, Posture& to);

// out = a at weight 0 and below, b at weight 1 and above; out may be a or b.
void blend_part(const Character& character, std::size_t part, const Posture& a, const Posture& b, double weight,
                Posture& out);

// out = the part continues from b for this many of the steps that led it from a to b; out may be a or b.
void coast_part(const Character& character, std::size_t part, const Posture& a, const Posture& b, double steps,
                Posture& out);

}  // namespace contort
