// Blends roots over standing feet, and moves a posture beneath along with them.
#pragma once

#include <span>

#include "model/motion/legs.h"
#include "model/character/character.h"
#include "model/world/environment.h"

namespace contort {

struct LegsBelow {
  const Character& character;
  std::span<const Leg> legs;
  const Environment& environment;
  double short_m = 0.0;  // legs are straight where hips are so much below their height at rest (GaitFrame)
};

// Blends from a at weight 0 to b at weight 1: place and rotation as blend_part does, but the height so that knees turn
// evenly. A height that blends linearly up to straight legs turns them ever faster: two bones of one length with a knee
// angle k reach cos(k/2) of their length. Legs that stand apart (short_m) are straight farther down, unless hips come
// from above that.
Rigid blend_root(const LegsBelow& below, const Rigid& a, const Rigid& b, double weight);

// Lowers a root that is higher than legs that stand apart reach to where they are almost straight, and returns by how
// much.
double lower_to_reach_m(const LegsBelow& below, Rigid& root);

// Returns the root of a posture that is moved from one place to another, at the same height over the ground.
Rigid brought_along(const LegsBelow& below, const Rigid& root, const Rigid& from, const Rigid& to);

}  // namespace contort
