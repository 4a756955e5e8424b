// The ground under a foot.
#pragma once

#include "model/motion/legs.h"
#include "model/world/environment.h"

namespace contort {

inline constexpr double kSteepestSole_rad = 25.0 * kRadPerDeg;  // about what ankles can do

// Points under a foot, in its sole's frame: a grid over the footprint.
inline constexpr int kAcross = 3;
inline constexpr int kLong = 7;
Vec3 footprint_point(const Leg& leg, int across, int lengthwise);

// The ground under a footprint, as a plane h + x·a + z·b in the sole's frame that nothing sticks out of.
struct Foothold {
  double height_m = 0.0;
  double slope_x = 0.0;  // at most as steep as kSteepestSole_rad
  double slope_z = 0.0;
  double unevenness_m = 0.0;  // between the plane and the lowest point
};
Foothold foothold_at(const Environment& environment, const Leg& leg, const Rigid& world_from_sole);

}  // namespace contort
