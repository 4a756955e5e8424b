// Joints near the ends of their ranges: a figure slows down before them and stops there. `held` marks the freedoms that
// standing feet hold and that are left alone: all joints of a standing leg follow its foot, and braking a knee that is
// nearly straight would throw the hips. A ball ends where its swing leaves its ellipse or its twist its range.
#pragma once

#include <array>
#include <span>

#include "generator/dynamics/tracker.h"

namespace contort {

// Bounds accelerations so that no joint is beyond its end so far ahead.
void slow_at_ends(const Character& character, const Multibody& body, std::span<const char> held,
                  const FigureState& state, double ahead_s, std::span<double> acceleration);

// Bounds velocities so that no joint leaves its range in this tick; one that is outside goes no farther.
void stop_at_ends(const Character& character, const Multibody& body, std::span<const char> held, double tick_s,
                  FigureState& state);

// Whether a hinge of a leg that a standing foot holds is beyond the end of its range by more than 0.03 rad, and goes
// farther. A knee that a walk stretches stays below that. No ground can hold a leg that bends so far.
bool overbends(const Character& character, const Multibody& body, std::span<const char> held, const FigureState& state);

// An end of a ball's range, for small turns (rotation vectors along the axes of the moved body): along `out` a turn may
// be `room_rad` at most, which is negative for a ball that is outside.
struct BallEnd {
  Vec3 out{0.0};  // unit
  double room_rad = 0.0;
};

// The ends of swing and twist. Empty if a turn by `turn_rad` stays inside of both.
struct BallEnds {
  std::array<BallEnd, 2> ends{};
  int count = 0;
  std::span<const BallEnd> all() const& { return std::span(ends).first(static_cast<std::size_t>(count)); }
  void all() && = delete;  // would point into a value that is gone
};
BallEnds ball_ends(const Joint& ball, const double* coords, const Vec3& turn_rad);
// The ends that are nearer than this, wherever the ball turns.
BallEnds near_ends(const Joint& ball, const double* coords, double within_rad);

}  // namespace contort
