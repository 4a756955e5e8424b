// Random solids, and oracles for their distance that share no code with checks/. Every core is a sum: of its centre, of
// generators times numbers in [-1, 1], and, for a hull, of a mean of its points. The difference of two cores is such a
// sum too, and the distance of cores is that of the origin from it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "model/geometry/distance.h"

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

// Sizes from 1 cm to 30 cm; half of the boxes are axis-aligned, some segments are points, and hulls have up to 64
// points.
inline ColliderShape random_shape(Random& r, Core core) {
  const Vec3 center = r.in_cube(0.25);
  if (core == Core::point) return Sphere{center, r.uniform(0.005, 0.1)};
  const Vec3 half = Vec3(0.155) + r.in_cube(0.145);
  if (core == Core::segment) {
    const Vec3 along = r.uniform(0, 1) < 0.1 ? Vec3(0.0) : half.x * r.direction();
    return Capsule{center - along, center + along, r.uniform(0.005, 0.1)};
  }
  if (core == Core::hull) {
    ConvexHull hull;
    const double count = r.uniform(4, r.uniform(0, 1) < 0.1 ? 64 : 20);
    while (static_cast<double>(hull.points_m.size()) < count)
      hull.points_m.push_back(center + half * (r.uniform(0, 1) < 0.7 ? r.direction() : r.in_cube(0.7)));
    return hull;
  }
  const Vec3 turn = r.uniform(0, 1) < 0.5 ? Vec3(0.0) : to_rotation_vector(r.rotation()) * kDegPerRad;
  return Box{center, half, turn};
}

inline Solid random_solid(Random& r, Core core) { return solid_of(random_shape(r, core)); }

struct Sum {
  Vec3 center;
  std::vector<Vec3> generators;
  std::vector<std::vector<Vec3>> means;  // each adds any weighted mean of its points
  // Farthest extent along the unit vector n.
  double support(const Vec3& n) const {
    double reach = glm::dot(center, n);
    for (const Vec3& g : generators) reach += std::fabs(glm::dot(g, n));
    for (const std::vector<Vec3>& points : means) {
      double most = -std::numeric_limits<double>::infinity();
      for (const Vec3& p : points) most = std::max(most, glm::dot(p, n));
      reach += most;
    }
    return reach;
  }
};

inline void add_core(const Solid& s, double sign, Sum& z) {
  if (s.core == Core::segment && s.half_length_m > 0.0) z.generators.push_back(s.half_length_m * s.axis);
  if (s.core == Core::box)
    for (int i = 0; i < 3; ++i) z.generators.push_back(s.axes[i] * s.half_m[i]);
  if (s.core == Core::hull) {
    z.means.emplace_back();
    for (const Vec3& corner : s.hull->corners_m) z.means.back().push_back(sign * (s.axes * corner));
  }
}

inline Sum difference_of_cores(const Solid& a, const Solid& b) {
  Sum z{a.center_m - b.center_m, {}, {}};
  add_core(a, 1.0, z);
  add_core(b, -1.0, z);
  return z;
}

// The distance of the origin from a sum lies in [low, high]: `high` by descending coordinate by coordinate from the
// centre, `low` because the plane across the point found there has the whole sum behind it. Within a mean, weight moves
// from the farthest point that has any to the nearest one (Mitchell, Demyanov and Malozemov 1974).
struct Bounds {
  double low = 0.0;
  double high = 0.0;
};

struct Weights {
  const std::vector<Vec3>* points;
  std::vector<double> of;
};

inline void shift_weight(Weights& w, Vec3& p) {
  std::size_t to = 0, from = 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t i = 0; i < w.of.size(); ++i) {
    const double d = glm::dot(p, (*w.points)[i]);
    if (d < least) least = d, to = i;
    if (w.of[i] > 0.0 && d > most) most = d, from = i;
  }
  const Vec3 step = (*w.points)[to] - (*w.points)[from];
  if (!(most > least) || glm::dot(step, step) == 0.0) return;
  const double moved = std::min(w.of[from], (most - least) / glm::dot(step, step));
  w.of[from] -= moved, w.of[to] += moved;
  p += moved * step;
}

inline Bounds distance_bounds(const Sum& z, int sweeps) {
  Vec3 p = z.center;
  std::vector<Weights> means;
  for (const std::vector<Vec3>& points : z.means) {
    means.push_back({&points, std::vector<double>(points.size(), 0.0)});
    means.back().of[0] = 1.0;
    p += points[0];
  }
  std::vector<double> u(z.generators.size(), 0.0);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < u.size(); ++i) {
      const Vec3& g = z.generators[i];
      if (glm::dot(g, g) == 0.0) continue;
      const double next = std::min(1.0, std::max(-1.0, u[i] - glm::dot(p, g) / glm::dot(g, g)));
      p += (next - u[i]) * g;
      u[i] = next;
      for (Weights& w : means) shift_weight(w, p);
    }
  if (z.generators.empty())
    for (int sweep = 0; sweep < 4 * sweeps; ++sweep)
      for (Weights& w : means) shift_weight(w, p);
  const double length = std::sqrt(glm::dot(p, p));
  if (length < 1e-12) return {0.0, length};
  return {-z.support(-p / length), length};
}

// Least extent of a sum that holds the origin, over directions: how far it must be moved to let the origin out.
// An upper bound of the depth. Every face is a local minimum, so steps are halved around many random directions.
inline double sampled_depth(const Sum& z, Random& r, int starts) {
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
  return core == Core::point ? "point" : core == Core::segment ? "segment" : core == Core::box ? "box" : "hull";
}

inline constexpr Core kCores[] = {Core::point, Core::segment, Core::box, Core::hull};
inline constexpr double kNoBand = 1e9;  // greater than any distance here, so all results are exact

}  // namespace contort::test_solids
