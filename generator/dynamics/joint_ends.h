// Joints near the ends of their ranges: a figure slows down before them and stops there. `held` marks the freedoms that
// standing feet hold and that are left alone: all joints of a standing leg follow its foot, and braking a knee that is
// nearly straight would throw the hips. A ball ends where its swing leaves its ellipse or its twist its range.
#pragma once

#include <optional>
#include <span>

#include "generator/dynamics/tracker.h"

namespace contort {

// Bounds accelerations so that no joint is beyond its end a shortest horizon (tracking.h) ahead.
void slow_at_ends(const Character& character, const Multibody& body, std::span<const char> held,
                  const FigureState& state, double tick_s, std::span<double> acceleration);

// Bounds velocities so that no joint leaves its range in this tick; one that is outside goes no farther.
void stop_at_ends(const Character& character, const Multibody& body, std::span<const char> held, double tick_s,
                  FigureState& state);

// The end that a ball comes to if it turns by `turn_rad` (a rotation vector along the axes of the moved body): turns
// along `out` may be `room_rad` at most, which is negative for a ball that is outside. Nothing if the turn stays inside.
struct BallEnd {
  Vec3 out{0.0};  // unit
  double room_rad = 0.0;
};
std::optional<BallEnd> ball_end(const Joint& ball, const double* coords, const Vec3& turn_rad);

}  // namespace contort
