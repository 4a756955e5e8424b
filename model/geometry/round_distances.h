// Measures signed distances of spheres and capsules, several pairs in each instruction. The result has the same bits as
// signed_distance: each SIMD lane does the same operations in the same order, without fused multiply-adds.
#pragma once

#include <span>

#include "model/geometry/distance.h"

namespace contort {

// A function that measures several pairs at a time, with the instructions that it is named after.
struct RoundKernel {
  const char* name;  // "SSE2" or "AVX2"; "portable" on other machines
  void (*measure)(const Solid* solids, std::span<const ColliderPair> pairs, double* distances_m);
};

// The kernels that this machine can run, the fastest last.
std::span<const RoundKernel> round_kernels();

// signed_distance of each pair of `solids`, whose cores are points and segments, without a band.
inline void round_distances(std::span<const Solid> solids, std::span<const ColliderPair> pairs,
                            std::span<double> distances_m, const RoundKernel& kernel = round_kernels().back()) {
  kernel.measure(solids.data(), pairs, distances_m.data());
}

}  // namespace contort
