// Finds legs by structure, not by name. A part with a reach chain is a leg if it, or a part attached to it, has a
// socket called "sole" (on the ground at rest, +Y up, +Z to the toes).
#pragma once

#include <array>
#include <vector>

#include "model/character/character.h"

namespace contort {

inline constexpr int kMaxLegs = 8;  // greatest number of a character's legs; further ones do not walk

struct Leg {
  int part = 0;       // the part with the reach chain
  int foot_part = 0;  // the part with the sole; may be the same
  int sole = 0;       // socket
  std::vector<int> joints;      // joints of both parts, carriers first
  std::array<int, 3> ankles{};  // joints between the chain's tip and the sole
  int ankle_count = 0;
  bool has_ankle_pair = false;  // the ankle is two hinges, one carrying the other, which inverse kinematics solves
                                // exactly
  Vec3 home_m{0.0};          // the sole at rest, in the character's frame (on the ground under the root)
  Vec3 hip_m{0.0};           // the chain's first joint at rest, in the character's frame
  Vec3 sole_from_ankle{0.0};  // the chain's tip at rest, in the sole's frame
  double length_m = 0.0;     // distance from hip to ankle, as far as the range of the joint between them allows
  double kept_bent_m = 0.0;  // by which that is less in a figure that keeps its knees bent
  double ankle_reserve_rad = 0.0;  // that ankles of a foot that stands keep from the ends of their ranges
  // Greatest tilt of the sole about its Z by the ankle, to either side; pi/2 if no hinge tilts it.
  double tilts_rad = kPi / 2;
  Vec3 low_m{0.0};           // the footprint: x and z of the colliders on the sole's joint, in the sole's frame
  Vec3 high_m{0.0};
  int row = 0;  // 0 is the rearmost pair
  int side = 0;  // 0 left, 1 right
};

// Returns the socket on which a leg stands, its own or that of a part attached to it; -1 if there is none.
int find_sole(const Character& character, int leg_part);

// Returns the legs in the order of slots. Legs whose feet are within 10 cm of each other along +Z are one row.
std::vector<Leg> find_legs(const Character& character);

}  // namespace contort
