// The recursions of dynamics.h, which take most of a tick, for several sets of instructions. All do the same operations
// in the same order, and none is fused: the bits are the same.
#pragma once

#include "generator/dynamics/dynamics.h"

namespace contort {

struct RecursionSet {
  const char* name;  // "any" or "AVX2"
  // place(): all but the root and the hinges' sines, which are in the scratch.
  void (*place_links)(const Multibody& body, std::span<const double> coords, DynamicsScratch& scratch);
  // inverse_dynamics(): all but the root's velocity and acceleration, which are in the scratch.
  void (*sum_forces)(const Multibody& body, std::span<const double> velocity, std::span<const double> acceleration,
                     DynamicsScratch& scratch, std::span<double> forces);
  // mass_matrix(), multiply() and placed_inertia(), the last by the lower root of the inertia.
  void (*fill_mass_matrix)(const Multibody& body, DynamicsScratch& scratch, std::span<double> matrix);
  void (*multiply)(std::span<const double> matrix, std::span<const double> x, std::span<double> out);
  void (*place_mass)(double mass_kg, const Vec3& center_of_mass_m, const Mat3& inertia_root, const Placement& link,
                     const Vec3& root_m, SpatialInertia& out);
};

// Returns the variants that this machine can run, the fastest last.
std::span<const RecursionSet> recursion_sets();

}  // namespace contort
