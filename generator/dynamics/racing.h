// Joints that exceed their greatest speed. Ticks are explicit steps: a figure whose joint turns by a radian or more in
// one gains energy from nothing, and its values become infinite. So no joint exceeds twice its limit (`fastest` by
// degree of freedom, rad/s or m/s; the root's is ignored), which is fast enough for `angular_velocity` to find it.
#pragma once

#include <span>

#include "generator/dynamics/multibody.h"

namespace contort {

inline constexpr double kRacing = 2.0;  // multiple of the limit

// Returns true if a tick with these accelerations would make a joint exceed that.
bool races(const Multibody& body, std::span<const double> fastest, std::span<const double> velocity,
           std::span<const double> acceleration, double tick_s);

// Bounds the velocities of joints; for balls, the length of the angular velocity.
void stop_racing(const Multibody& body, std::span<const double> fastest, std::span<double> velocity);

}  // namespace contort
