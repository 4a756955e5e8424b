// Joints that exceed their greatest speed. Ticks are explicit steps: a figure whose joint turns by a radian or more in
// one gains energy from nothing, and its values become infinite. So no joint exceeds twice its limit (`fastest` by
// degree of freedom, rad/s or m/s), which is fast enough for `angular_velocity` to find it, and the root turns at most by
// kFastestSpin_rad_s.
#pragma once

#include <span>

#include "generator/dynamics/multibody.h"

namespace contort {

inline constexpr double kRacing = 2.0;  // multiple of the limit
inline constexpr double kFastestSpin_rad_s = 100.0;  // figure skaters reach 36

// Returns true if a tick with these accelerations would make a joint exceed that.
bool races(const Multibody& body, std::span<const double> fastest, std::span<const double> velocity,
           std::span<const double> acceleration, double tick_s);

// Bounds the velocities of joints and the root's rotation; for balls, the length of the angular velocity. Returns true
// if one was too fast.
bool stop_racing(const Multibody& body, std::span<const double> fastest, std::span<double> velocity);

}  // namespace contort
