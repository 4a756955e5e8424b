// Finds the times in which the feet of a recorded motion rest on the ground. Recordings do not say it, and their feet
// float, sink in, tilt and slide, because they come from other figures. Feet that rest are slow in any case: a heel or
// the front end of a foot rests while it is slow and about as low as it mostly is when slow (compare the foot speed
// method of O'Connor et al., "Automatic detection of gait events using kinematic data", Gait & Posture 25, 2007).
#pragma once

#include <span>
#include <vector>

#include "model/motion/legs.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

// The sole of one leg by frame, in the world.
using SolePath = std::vector<Rigid>;

// Returns the path of each leg's sole.
std::vector<SolePath> sole_paths(const Character& character, std::span<const Leg> legs, const Motion& motion);

struct FootRest {
  int first = 0;           // first frame
  int last = 0;            // last frame, inclusive
  std::vector<int> flat;   // the frames, rising, in which heel and front end rest, without those in which they begin or
                           // cease to; empty if there are none
};

// Returns the rests of one leg in the order of time, with at least two frames in the air between them. Shorter than
// 0.08 s is no rest, except at the motion's ends.
std::vector<FootRest> find_rests(const Leg& leg, const SolePath& path, const Environment& environment, double rate_hz);

// The angular frequency of a leg as a pendulum, sqrt(g / l), rad/s.
double pendulum_rad_s(const Leg& leg);

// The ground under a point, and the height of the point above it, m.
struct GroundBelow {
  Vec3 normal{0.0, 1.0, 0.0};
  double height_m = 0.0;
};
GroundBelow ground_below(const Environment& environment, const Vec3& point_m);

}  // namespace contort
