// Joints that go faster than they can. Ticks are explicit steps: a figure whose joint turns by a radian or more in one
// gains energy from nothing, and ends with numbers that are not finite. So no joint goes faster than twice its limit
// (`fastest` by freedom, rad/s or m/s; the root's is not looked at), which is fast enough for `angular_velocity` to
// find it.
#pragma once

#include <span>

#include "generator/dynamics/multibody.h"

namespace contort {

inline constexpr double kRacing = 2.0;  // times its limit

// Whether a tick with these accelerations would make a joint race.
bool races(const Multibody& body, std::span<const double> fastest, std::span<const double> velocity,
           std::span<const double> acceleration, double tick_s);

// Bounds the velocities of joints, those of balls by their length.
void stop_racing(const Multibody& body, std::span<const double> fastest, std::span<double> velocity);

}  // namespace contort
