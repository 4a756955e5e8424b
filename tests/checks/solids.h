// Random solids, and oracles for their distance that share no code with checks/distance.cpp. Every core is a zonotope:
// the centre plus a sum of generators, each times a number in [-1, 1]. So is the difference of two cores, and a
// distance of cores is that of the origin from a zonotope.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "checks/distance.h"

namespace contort::test_solids {

using Core = Solid::Core;

struct Random {
  explicit Random(std::uint64_t seed) : engine(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
  }
  Vec3 in_cube(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
    return {x, y, z};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_cube(1.0);
      const double n = std::sqrt(glm::dot(v, v));
      if (n > 0.1 && n <= 1.0) return v / n;
    }
  }
  Quat rotation() { return from_rotation_vector(direction() * uniform(0.0, kPi)); }
  Rigid rigid(double half) {
    const Quat q = rotation();
    return {q, in_cube(half)};
  }
  std::mt19937_64 engine;
};

// Sizes from 1 cm to 30 cm; half of the boxes are axis-aligned, and some segments are points.
inline ColliderShape random_shape(Random& r, Core core) {
  const Vec3 center = r.in_cube(0.25);
  if (core == Core::point) return Sphere{center, r.uniform(0.005, 0.1)};
  const Vec3 half = Vec3(0.155) + r.in_cube(0.145);
  if (core == Core::segment) {
    const Vec3 along = r.uniform(0, 1) < 0.1 ? Vec3(0.0) : half.x * r.direction();
    return Capsule{center - along, center + along, r.uniform(0.005, 0.1)};
  }
  const Vec3 turn = r.uniform(0, 1) < 0.5 ? Vec3(0.0) : to_rotation_vector(r.rotation()) * kDegPerRad;
  return Box{center, half, turn};
}

inline Solid random_solid(Random& r, Core core) { return solid_of(random_shape(r, core)); }

struct Zonotope {
  Vec3 center;
  std::vector<Vec3> generators;
  // Farthest extent along the unit vector n.
  double support(const Vec3& n) const {
    double reach = glm::dot(center, n);
    for (const Vec3& g : generators) reach += std::fabs(glm::dot(g, n));
    return reach;
  }
};

inline void add_generators(const Solid& s, Zonotope& z) {
  if (s.core == Core::segment) z.generators.push_back(s.half_segment_m);
  if (s.core == Core::box)
    for (int i = 0; i < 3; ++i) z.generators.push_back(s.axes[i] * s.half_m[i]);
}

inline Zonotope difference_of_cores(const Solid& a, const Solid& b) {
  Zonotope z{a.center_m - b.center_m, {}};
  add_generators(a, z);
  add_generators(b, z);
  return z;
}

// The distance of the origin from a zonotope lies in [low, high]: `high` by descending coordinate by coordinate from
// the centre, `low` because the plane across the point found there has the whole zonotope behind it.
struct Bounds {
  double low = 0.0;
  double high = 0.0;
};

inline Bounds distance_bounds(const Zonotope& z, int sweeps) {
  Vec3 p = z.center;
  std::vector<double> u(z.generators.size(), 0.0);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < u.size(); ++i) {
      const Vec3& g = z.generators[i];
      if (glm::dot(g, g) == 0.0) continue;
      const double next = std::min(1.0, std::max(-1.0, u[i] - glm::dot(p, g) / glm::dot(g, g)));
      p += (next - u[i]) * g;
      u[i] = next;
    }
  const double length = std::sqrt(glm::dot(p, p));
  if (length < 1e-12) return {0.0, length};
  return {-z.support(-p / length), length};
}

// Least extent of a zonotope that holds the origin, over directions: how far it must be moved to let the origin out.
// An upper bound of the depth. Every face is a local minimum, so steps are halved around many random directions.
inline double sampled_depth(const Zonotope& z, Random& r, int starts) {
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < starts; ++start) {
    Vec3 best = r.direction();
    for (double step = 0.3; step > 1e-6; step *= 0.7)
      for (int i = 0; i < 24; ++i) {
        const Vec3 near = best + step * r.direction();
        const Vec3 n = near / std::sqrt(glm::dot(near, near));
        if (z.support(n) < z.support(best)) best = n;
      }
    least = std::min(least, z.support(best));
  }
  return least;
}

inline const char* name_of(Core core) {
  return core == Core::point ? "point" : core == Core::segment ? "segment" : "box";
}

inline constexpr Core kCores[] = {Core::point, Core::segment, Core::box};
inline constexpr double kNoBand = 1e9;  // greater than any distance here: everything is exact

}  // namespace contort::test_solids
