// Feet that are led: accelerations with which soles stay where they stand, roll about their edges, or go through the
// air as their target does. A led sole takes six freedoms.
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/dynamics.h"

namespace contort {

// A sole that moves: its pose, and its velocity (m/s, rad/s, world axes).
struct SoleMotion {
  Rigid world_from_sole;
  Vec3 linear{0.0};
  Vec3 angular{0.0};
};

struct LedSole {
  int link = 0;
  Rigid link_from_sole;
  SoleMotion wanted;  // now
  Vec3 linear_m_s2{0.0};
  Vec3 angular_rad_s2{0.0};
};

// The conditions of led soles on accelerations: J a = wanted, six rows a foot (linear at the sole, then angular;
// world). J is kept by columns, as most are 0: a freedom moves the feet below it. Memory of the caller, reused.
struct SupportRows {
  int count = 0;                        // rows
  std::vector<double> columns;          // dof_count x count: J transposed
  std::vector<int> dofs;                // the columns that are not 0, ascending
  std::vector<double> wanted;           // count
  std::vector<double> scratch;          // of the solver
  std::vector<double> project_factors;  // of J E J^T, E: ease
  std::vector<double> factors;          // of keep_feet

  std::span<const double> column(int dof) const {
    return std::span(columns).subspan(static_cast<std::size_t>(dof * count), static_cast<std::size_t>(count));
  }
};

// The rows at the pose and velocities of an inverse_dynamics with acceleration 0 and this gravity. Soles that are
// elsewhere are brought back as by a critically damped spring of this frequency (J. Baumgarte, "Stabilization of
// constraints and integrals of motion in dynamical systems", 1972).
void support_rows(const Multibody& body, std::span<const LedSole> feet, std::span<const double> velocity,
                  double frequency_rad_s, double gravity_m_s2, const DynamicsScratch& dynamics, SupportRows& support);

// out = J x
void soles_moved_by(const SupportRows& support, std::span<const double> x, std::span<double> out);

// Once for the rows, before the two below: a change of freedom k costs its square by ease[k].
void prepare_projection(std::span<const double> ease, SupportRows& support);

// The accelerations nearest to the given ones that the feet allow, in place. Where rows depend on one another (a
// straight knee) the wanted ones are met as nearly as they can be.
void project_on_support(std::span<const double> ease, SupportRows& support, std::span<double> acceleration);

// Takes from a change of accelerations, or from velocities, all that would move the soles, in place.
void keep_still(std::span<const double> ease, SupportRows& support, std::span<double> change);

// Changes of acceleration that would move standing soles, with the legs giving way so that they stay: `legs` marks
// their freedoms. prepare once for all of a tick.
void prepare_keep_feet(std::span<const char> legs, SupportRows& support);
void keep_feet(std::span<const char> legs, SupportRows& support, std::span<double> change);

}  // namespace contort
