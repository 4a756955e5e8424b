// Computes the distance of two segments, for capsules and the edges of polyhedra.
#pragma once

#include <algorithm>
#include <cmath>

#include "model/core/math.h"

namespace contort {

// A segment's points are center + t * axis, t in [-half_length, half_length]. The axis is a unit vector, also for a
// point, whose axis is arbitrary: with a unit axis the solution needs only one division.
struct Segment {
  Vec3 center;
  Vec3 axis;
  double half_length;
};

inline Segment segment_between(const Vec3& from, const Vec3& to) {
  const Vec3 half = 0.5 * (to - from);
  return {0.5 * (from + to), unit_or(half, Vec3(1, 0, 0)), std::sqrt(glm::dot(half, half))};
}

// Below this squared sine of the angle between two segments, rounding makes products of lengths useless.
inline constexpr double kNearlyParallel = 1e-8;

// Closest points of two segments, a.center + s * a.axis and b.center + t * b.axis: the minimum of a convex quadratic
// over a rectangle. Solve for s, clamp it, solve for t; if t had to be clamped, solve for s again with the clamped t
// (Ericson, Real-Time Collision Detection, 2005, 5.1.9).
struct ClosestOnSegments {
  double s = 0.0;
  double t = 0.0;
};

inline ClosestOnSegments closest_on_segments(const Segment& a, const Segment& b) {
  const Vec3 between = a.center - b.center;
  const double ab = glm::dot(a.axis, b.axis);
  const double ar = glm::dot(a.axis, between);
  const double br = glm::dot(b.axis, between);
  const double squared_sine = 1.0 - ab * ab;
  double s = 0.0;  // parallel segments and points: s is arbitrary, and t follows from it
  if (squared_sine > kNearlyParallel) {
    s = std::clamp((ab * br - ar) / squared_sine, -a.half_length, a.half_length);
  } else if (a.half_length > 0.0 && b.half_length > 0.0) {
    // The same solution without the difference of two nearly equal products (Goldman, Graphics Gems, 1990, p. 304).
    const Vec3 across = glm::cross(a.axis, b.axis);
    const double squared = glm::dot(across, across);
    if (squared > 0.0)
      s = std::clamp(glm::dot(glm::cross(b.axis, between), across) / squared, -a.half_length, a.half_length);
  }
  const double free_t = ab * s + br;
  const double t = std::clamp(free_t, -b.half_length, b.half_length);
  if (t != free_t) s = std::clamp(ab * t - ar, -a.half_length, a.half_length);
  return {s, t};
}

// Returns the vector from the point of b that is nearest to a, to the point of a that is nearest to b.
inline Vec3 between_segments(const Segment& a, const Segment& b) {
  const ClosestOnSegments at = closest_on_segments(a, b);
  return (a.center - b.center) + at.s * a.axis - at.t * b.axis;
}

inline double segment_distance(const Segment& a, const Segment& b) {
  const Vec3 apart = between_segments(a, b);
  return std::sqrt(glm::dot(apart, apart));
}

}  // namespace contort
