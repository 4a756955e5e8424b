// The recursions of dynamics.h, which take most of a tick, for several sets of instructions. All do the same operations
// in the same order, without fusing, so their bits are equal.
#pragma once

#include "generator/dynamics/dynamics.h"

namespace contort {

struct RecursionSet {
  const char* name;  // "any" or "AVX2"
  // place(), without the root and the hinges' sines, which are in the scratch.
  void (*place_links)(const Multibody& body, std::span<const double> coords, DynamicsScratch& scratch);
  // inverse_dynamics(), without the root's velocity and acceleration, which are in the scratch.
  void (*sum_forces)(const Multibody& body, std::span<const double> velocity, std::span<const double> acceleration,
                     DynamicsScratch& scratch, std::span<double> forces);
  // mass_matrix(), multiply() and placed_inertia(); the latter uses the lower root of the inertia.
  void (*fill_mass_matrix)(const Multibody& body, DynamicsScratch& scratch, std::span<double> matrix);
  void (*multiply)(std::span<const double> matrix, std::span<const double> x, std::span<double> out);
  void (*place_mass)(double mass_kg, const Vec3& center_of_mass_m, const Mat3& inertia_root, const Placement& link,
                     const Vec3& root_m, SpatialInertia& out);
};

// Returns the variants that this machine can run, the fastest last.
std::span<const RecursionSet> recursion_sets();

}  // namespace contort
