// Joints near the ends of their ranges: a figure slows down before them and stops there. `held` marks the freedoms that
// standing feet hold and that are left alone: all joints of a standing leg follow its foot, and braking a knee that is
// nearly straight would throw the hips. Balls are not stopped.
#pragma once

#include <span>

#include "generator/dynamics/tracker.h"

namespace contort {

// Bounds accelerations so that no joint is beyond its end a shortest horizon (tracking.h) ahead.
void slow_at_ends(const Character& character, const Multibody& body, std::span<const char> held,
                  const FigureState& state, double tick_s, std::span<double> acceleration);

// Bounds velocities so that no joint leaves its range in this tick; one that is outside goes no farther.
void stop_at_ends(const Character& character, const Multibody& body, std::span<const char> held, double tick_s,
                  FigureState& state);

}  // namespace contort
