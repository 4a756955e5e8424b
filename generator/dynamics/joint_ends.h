// Joints near the ends of their ranges: a figure slows down before them and stops there. `held` marks degrees of
// freedom that standing feet hold and that are not changed: all joints of a standing leg follow its foot, and braking a
// nearly straight knee would throw the hips. The end of a ball is the ellipse of its swing or an end of its twist.
#pragma once

#include <array>
#include <span>

#include "generator/dynamics/tracker.h"

namespace contort {

// Bounds accelerations so that no joint passes its end within `ahead_s`, except as far as the target would pass it at
// its present rate and acceleration. A target comes to an end as softly as it must, and a figure that keeps to it and
// slowed down sooner would arrive late.
void slow_at_ends(const Character& character, const Multibody& body, std::span<const char> held,
                  const FigureState& state, const TargetAhead& target, double ahead_s, std::span<double> acceleration);

// Bounds velocities so that no joint leaves its range in this tick; a joint that is outside goes no farther.
void stop_at_ends(const Character& character, const Multibody& body, std::span<const char> held, double tick_s,
                  FigureState& state);

// Turns balls that are outside of their ranges to the nearest place inside. The ends of a ball are curved, so that a
// tick, which goes straight, passes them by a little, also where its velocity is bounded.
void put_balls_inside(const Character& character, const Multibody& body, FigureState& state);

// Puts hinges of legs that stand (`held`) back to their ends if they are beyond by at most 0.1 degrees. A foot that is
// guided along a target at the end of a range overshoots it by less, and its sole moves by some 0.1 mm.
void put_legs_inside(const Character& character, const Multibody& body, std::span<const char> held, FigureState& state);

// Returns true if a hinge of a leg with a standing foot is beyond the end of its range, and beyond its angle in the
// target (by coordinate), by more than 0.03 rad, and moving outward. A knee that a walk stretches stays below that. No
// ground can hold a leg that bends so far.
bool overbends(const Character& character, const Multibody& body, std::span<const char> held,
               std::span<const double> target, const FigureState& state);

// An end of a ball's range, for small rotations (rotation vectors along the axes of the moved body): along `out` a
// rotation may be at most `room_rad`, which is negative for a ball that is outside.
struct BallEnd {
  Vec3 out{0.0};  // unit
  double room_rad = 0.0;
};

// The ends of swing and twist. Empty if a rotation by `turn_rad` stays inside of both.
struct BallEnds {
  std::array<BallEnd, 2> ends{};
  int count = 0;
  std::span<const BallEnd> all() const& { return std::span(ends).first(static_cast<std::size_t>(count)); }
  void all() && = delete;  // would refer into a temporary value
};
BallEnds ball_ends(const Joint& ball, const double* coords, const Vec3& turn_rad);
// The ends that are nearer than this, in all directions.
BallEnds near_ends(const Joint& ball, const double* coords, double within_rad);

}  // namespace contort
