// Tracking control (seed D2): every joint separately, without mass, follows a target that is a function of time. The
// present acceleration is that of the cubic from the present angle and rate to the target's angle and rate at its next
// knot. Planned anew in every tick, this acts like a spring and damper that become stiffer as the knot approaches
// (docs/internals/dynamics.md).
#pragma once

#include <span>
#include <vector>

#include "model/core/math.h"

namespace contort {

// The acceleration at the start of the cubic from (from, from_rate) to (to, to_rate) in time_s > 0.
double cubic_acceleration(double from, double from_rate, double to, double to_rate, double time_s);

// The same for a rotation: rates and the result are along the axes of the moved body. The cubic is in the rotation
// vector from `from`, which is exact at its start.
Vec3 cubic_acceleration(const Quat& from, const Vec3& from_rate, const Quat& to, const Vec3& to_rate, double time_s);

struct KnotOptions {
  double wiggle = 0.2 * kRadPerDeg;     // an extremum must differ by at least this from the one before it
  double tolerance = 1.5 * kRadPerDeg;  // greatest distance between a cubic and the target, between two knots
};

// The frames in which a target (one value per frame) has a knot: extrema, starts and ends of plateaus, frames in
// between if the cubic would be too far off, and the last frame. In rising order; frame 0 is never one.
std::vector<int> find_knots(std::span<const double> target, const KnotOptions& options = {});

// The knots of both, in order: joints of one closed chain must share their knots, otherwise they pull against each
// other.
std::vector<int> merged_knots(std::span<const int> a, std::span<const int> b);

// The horizon of control, in seconds, at a time (in frames, with fractions): up to the next knot, but never less than
// the shortest horizon; kHold_s if there is no knot for longer than kFarthest_s.
//
// With a period D between two ticks the law is stable only for horizons above 2.58 D, by Jury's criterion for
// semi-implicit Euler: 6 r^2 + 8 r < 4 with r = D / T. shortest_horizon_s keeps 3 D and 0.1 s.
double shortest_horizon_s(double tick_s);
double horizon_s(std::span<const int> knots, double frame, double rate_hz, double tick_s);

inline constexpr double kFarthest_s = 1.2;
inline constexpr double kHold_s = 0.3;

}  // namespace contort
