// Guided feet: accelerations with which soles stay where they stand, roll about their edges, or move through the air as
// in their target. A guided sole takes six degrees of freedom.
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/dynamics.h"

namespace contort {

// A hinge at an end of its range; `out` is the sign of a rate that would leave the range.
struct DofEnd {
  int dof = 0;
  double out = 1.0;
};

// The motion of a sole: its pose, and its velocity (m/s, rad/s, world axes).
struct SoleMotion {
  Rigid world_from_sole;
  Vec3 linear{0.0};
  Vec3 angular{0.0};
};

struct LedSole {
  int link = 0;
  Rigid link_from_sole;
  SoleMotion wanted;  // wanted pose and velocity at present
  Vec3 linear_m_s2{0.0};
  Vec3 angular_rad_s2{0.0};
};

// The conditions of guided soles on accelerations: J a = wanted, six rows for each foot (linear at the sole, then
// angular; world), and rows of single degrees of freedom. J is stored by columns, because most are 0: a degree of
// freedom moves only feet below it. The caller owns it and reuses its memory.
struct SupportRows {
  int count = 0;                        // rows
  std::vector<double> columns;          // dof_count x count: J transposed
  std::vector<int> dofs;                // indices of the columns that are not 0, ascending
  std::vector<double> wanted;           // count
  std::vector<double> scratch;          // scratch of the solver
  std::vector<double> project_factors;  // factors of J E J^T, E: ease
  std::vector<double> factors;          // factors of keep_feet

  std::span<const double> column(int dof) const {
    return std::span(columns).subspan(static_cast<std::size_t>(dof * count), static_cast<std::size_t>(count));
  }
};

// The rows at the pose and velocities of an inverse_dynamics. Soles that are off their place return as by a critically
// damped spring of this frequency (J. Baumgarte, "Stabilization of constraints and integrals of motion in dynamical
// systems", 1972). Rates of semi-implicit Euler are half a tick old (`late_s`), and `velocity` is that of the present.
// Without this distinction a foot that swings fast comes centimetres off its path. After the rows of the feet there is
// one for each of `still_dofs`: it is not accelerated.
void support_rows(const Multibody& body, std::span<const LedSole> feet, std::span<const double> velocity,
                  std::span<const int> still_dofs, double frequency_rad_s, double late_s,
                  const DynamicsScratch& dynamics, SupportRows& support);

// Computes out = J x.
void soles_moved_by(const SupportRows& support, std::span<const double> x, std::span<double> out);

// Call once for the rows, before the two functions below. The cost of a change in degree of freedom k is its square
// times ease[k].
void prepare_projection(std::span<const double> ease, SupportRows& support);

// Replaces accelerations by the nearest ones that the feet allow. If rows are dependent (a straight knee), the wanted
// ones are met as nearly as possible.
void project_on_support(std::span<const double> ease, SupportRows& support, std::span<double> acceleration);

// Removes from a change of accelerations, or from velocities, everything that would move the soles.
void keep_still(std::span<const double> ease, SupportRows& support, std::span<double> change);

// Changes of acceleration that would move standing soles, while the legs give way so that they stay: `legs` marks their
// degrees of freedom. Call prepare once for all changes of a tick.
void prepare_keep_feet(std::span<const char> legs, SupportRows& support);
void keep_feet(std::span<const char> legs, SupportRows& support, std::span<double> change);

}  // namespace contort
