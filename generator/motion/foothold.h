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

// The ground under a footprint, as a plane h + x·a + z·b in the sole's frame with no point of the ground above it.
struct Foothold {
  double height_m = 0.0;
  double slope_x = 0.0;  // at most as steep as kSteepestSole_rad
  double slope_z = 0.0;
  double unevenness_m = 0.0;  // between the plane and the lowest point
};
Foothold foothold_at(const Environment& environment, const Leg& leg, const Rigid& world_from_sole);

// Returns world_from_sole of a foot with this rotation, put down on the ground near a place. Of a few places along a
// direction it takes the most even one, and prefers near ones.
Rigid stand_at(const Environment& environment, const Leg& leg, const Quat& turn, const Vec3& at_m,
               const Vec3& direction);

// Returns the place of a foot at rest under a character that stands here, on the plane y = 0.
inline Vec3 home_of(const Leg& leg, const Rigid& world_from_start) {
  return world_from_start * Vec3(leg.home_m.x, 0.0, leg.home_m.z);
}

// Returns the first foothold under a character that starts here: its present sole, put down on the ground, or its home
// place if that sole is too far away, high above the ground, or not given (null).
Rigid first_sole(const Environment& environment, const Leg& leg, const Rigid& world_from_start, const Rigid* seen);

}  // namespace contort
