// Distance of two segments, which capsules and the edges of polyhedra share.
#pragma once

#include <algorithm>
#include <cmath>

#include "generator/core/math.h"

namespace contort {

// A segment as centre and half vector: its points are center + t * half, t in [-1, 1].
struct Segment {
  Vec3 center;
  Vec3 half;
};

// Below this squared sine of the angle between two segments, products of lengths tell nothing about it any more.
inline constexpr double kNearlyParallel = 1e-8;

// Closest points of two segments, a.center + s * a.half and b.center + t * b.half: the minimum of a convex quadratic over
// a square. Solve for s, clamp it, solve for t; if that had to be clamped, s again for the t that is left (Ericson,
// Real-Time Collision Detection, 2005, 5.1.9).
struct ClosestOnSegments {
  double s = 0.0;
  double t = 0.0;
};

inline ClosestOnSegments closest_on_segments(const Segment& a, const Segment& b) {
  const Vec3 between = a.center - b.center;
  const double aa = glm::dot(a.half, a.half);
  const double bb = glm::dot(b.half, b.half);
  const double ab = glm::dot(a.half, b.half);
  const double ar = glm::dot(a.half, between);
  const double br = glm::dot(b.half, between);
  const double determinant = aa * bb - ab * ab;
  double s = 0.0;  // parallel segments and points: any s will do, t settles the rest
  if (determinant > kNearlyParallel * aa * bb) {
    s = std::clamp((ab * br - ar * bb) / determinant, -1.0, 1.0);
  } else if (const Vec3 across = glm::cross(a.half, b.half); glm::dot(across, across) > 0.0) {
    // The same solution without the difference of two nearly equal products (Goldman, Graphics Gems, 1990, p. 304).
    s = std::clamp(glm::dot(glm::cross(b.half, between), across) / glm::dot(across, across), -1.0, 1.0);
  }
  const double free_t = bb > 0.0 ? (ab * s + br) / bb : 0.0;
  const double t = std::clamp(free_t, -1.0, 1.0);
  if ((t != free_t || bb == 0.0) && aa > 0.0) s = std::clamp((ab * t - ar) / aa, -1.0, 1.0);
  return {s, t};
}

inline double segment_distance(const Segment& a, const Segment& b) {
  const ClosestOnSegments at = closest_on_segments(a, b);
  const Vec3 apart = (a.center - b.center) + at.s * a.half - at.t * b.half;
  return std::sqrt(glm::dot(apart, apart));
}

}  // namespace contort
