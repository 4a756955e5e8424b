#include "model/geometry/round_distances.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "model/geometry/segment_distance.h"

namespace contort {

namespace {

// Vector types of GCC and Clang.
using Twos [[gnu::vector_size(16)]] = double;
using Fours [[gnu::vector_size(32)]] = double;

template <class Mask>
[[gnu::always_inline]] inline bool all_of(const Mask& mask) {
  bool all = true;
  for (std::size_t lane = 0; lane < sizeof(Mask) / sizeof mask[0]; ++lane) all &= mask[lane] != 0;
  return all;
}

void measure_one_by_one(const Solid* solids, std::span<const ColliderPair> pairs, double* distances_m) {
  for (std::size_t i = 0; i < pairs.size(); ++i)
    distances_m[i] = signed_distance(solids[pairs[i].a], solids[pairs[i].b], std::numeric_limits<double>::infinity());
}

// Computes a few pairs at once, with the formula of closest_on_segments. Returns false if one of them is nearly
// parallel or has no finite distance; the caller then computes them separately. It is one long function, because
// kernels for different instructions cannot share a function of vectors.
template <class Lanes, std::size_t... kLane>
[[gnu::always_inline]] inline bool measure_few(const Solid* solids, const ColliderPair* pairs, double* distances_m,
                                               std::index_sequence<kLane...>) {
  const Solid* const a[] = {&solids[pairs[kLane].a]...};
  const Solid* const b[] = {&solids[pairs[kLane].b]...};
  const Lanes ax = {a[kLane]->center_m.x...}, ay = {a[kLane]->center_m.y...}, az = {a[kLane]->center_m.z...};
  const Lanes bx = {b[kLane]->center_m.x...}, by = {b[kLane]->center_m.y...}, bz = {b[kLane]->center_m.z...};
  const Lanes ux = {a[kLane]->axis.x...}, uy = {a[kLane]->axis.y...}, uz = {a[kLane]->axis.z...};
  const Lanes vx = {b[kLane]->axis.x...}, vy = {b[kLane]->axis.y...}, vz = {b[kLane]->axis.z...};
  const Lanes a_length = {a[kLane]->half_length_m...}, b_length = {b[kLane]->half_length_m...};
  const Lanes radii = {(a[kLane]->radius_m + b[kLane]->radius_m)...};
  const Lanes zero = {}, one = zero + 1.0;
  const Lanes dx = ax - bx, dy = ay - by, dz = az - bz;
  const Lanes ab = ux * vx + uy * vy + uz * vz;
  const Lanes ar = ux * dx + uy * dy + uz * dz;
  const Lanes br = vx * dx + vy * dy + vz * dz;
  const Lanes squared_sine = one - ab * ab;
  const auto crosses = squared_sine > kNearlyParallel;
  Lanes s = (ab * br - ar) / squared_sine;
  s = s < -a_length ? -a_length : s;
  s = a_length < s ? a_length : s;
  s = crosses ? s : zero;
  const Lanes free_t = ab * s + br;
  Lanes t = free_t < -b_length ? -b_length : free_t;
  t = b_length < t ? b_length : t;
  Lanes s_of_t = ab * t - ar;
  s_of_t = s_of_t < -a_length ? -a_length : s_of_t;
  s_of_t = a_length < s_of_t ? a_length : s_of_t;
  s = t != free_t ? s_of_t : s;
  const Lanes px = dx + s * ux - t * vx, py = dy + s * uy - t * vy, pz = dz + s * uz - t * vz;
  const Lanes squared = px * px + py * py + pz * pz;
  const Lanes apart = {std::sqrt(squared[kLane])...};
  const Lanes distances = apart - radii;
  std::memcpy(distances_m, &distances, sizeof distances);
  const Lanes poison = ax + ay + az + bx + by + bz;  // as in signed_distance: NaN if a coordinate is not finite
  const auto is_finite = (poison - poison == zero) & (squared - squared == zero);
  return all_of((crosses | (a_length == zero) | (b_length == zero)) & is_finite);
}

template <class Lanes>
[[gnu::always_inline]] inline void measure_all(const Solid* solids, std::span<const ColliderPair> pairs,
                                               double* distances_m) {
  constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(double);
  std::size_t i = 0;
  for (; i + kLanes <= pairs.size(); i += kLanes)
    if (!measure_few<Lanes>(solids, &pairs[i], distances_m + i, std::make_index_sequence<kLanes>()))
      measure_one_by_one(solids, pairs.subspan(i, kLanes), distances_m + i);
  measure_one_by_one(solids, pairs.subspan(i), distances_m + i);
}

void measure_in_twos(const Solid* solids, std::span<const ColliderPair> pairs, double* distances_m) {
  measure_all<Twos>(solids, pairs, distances_m);
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void measure_by_avx2(const Solid* solids, std::span<const ColliderPair> pairs,
                                             double* distances_m) {
  measure_all<Fours>(solids, pairs, distances_m);
}
#endif

std::vector<RoundKernel> find_kernels() {
#ifdef __x86_64__
  std::vector<RoundKernel> found{{"SSE2", measure_in_twos}};
  if (__builtin_cpu_supports("avx2")) found.push_back({"AVX2", measure_by_avx2});
  return found;
#else
  return {{"portable", measure_in_twos}};
#endif
}

}  // namespace

std::span<const RoundKernel> round_kernels() {
  static const std::vector<RoundKernel> kernels = find_kernels();
  return kernels;
}

}  // namespace contort
