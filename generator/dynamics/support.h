// Feet that stand: accelerations that keep them where they are. A standing sole is fixed with all six freedoms.
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/dynamics.h"

namespace contort {

struct StandingFoot {
  int link = 0;
  Rigid link_from_sole;
  Rigid world_from_sole;  // where it was put down
};

// The conditions of standing feet on accelerations: J a = wanted, six rows a foot (linear at the sole, then angular;
// world). J is kept by columns, as most are 0: a freedom moves the feet below it. Memory of the caller, reused.
struct SupportRows {
  int count = 0;                // rows
  std::vector<double> columns;  // dof_count x count: J transposed
  std::vector<int> dofs;        // whose columns are not 0, rising
  std::vector<double> wanted;   // count
  std::vector<double> scratch;  // of the solver
  std::vector<double> factors;  // of keep_feet

  std::span<const double> column(int dof) const {
    return std::span(columns).subspan(static_cast<std::size_t>(dof * count), static_cast<std::size_t>(count));
  }
};

// The rows at the pose and velocities of an inverse_dynamics with acceleration 0 and this gravity. Soles that have
// moved are brought back as by a critically damped spring of this frequency (J. Baumgarte, "Stabilization of
// constraints and integrals of motion in dynamical systems", 1972).
void support_rows(const Multibody& body, std::span<const StandingFoot> feet, std::span<const double> velocity,
                  double frequency_rad_s, double gravity_m_s2, const DynamicsScratch& dynamics, SupportRows& support);

// out = J x
void soles_moved_by(const SupportRows& support, std::span<const double> x, std::span<double> out);

// The accelerations nearest to the given ones that the feet allow, in place: a change of freedom k costs its square by
// ease[k]. Where rows depend on one another (a straight knee) the wanted ones are met as nearly as they can be.
void project_on_support(std::span<const double> ease, SupportRows& support, std::span<double> acceleration);

// Velocities nearest to the given ones that move no standing sole, by the same costs: what is left of a step when the
// foot has landed.
void stop_feet(std::span<const double> ease, SupportRows& support, std::span<double> velocity);

// Changes of acceleration that would move standing soles, with the legs giving way so that they stay: `legs` marks
// their freedoms. prepare once for all of a tick.
void prepare_keep_feet(std::span<const char> legs, SupportRows& support);
void keep_feet(std::span<const char> legs, SupportRows& support, std::span<double> change);

}  // namespace contort
