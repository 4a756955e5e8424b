// Finds the point at which the ground's force must act so that a figure's centre of mass follows its target's. The
// capture point c + c' / w, w = sqrt(g / h), moves away from the zero moment point at the rate w. If the zero moment
// point is farther behind it than in the target, the capture point is led back (J. Pratt et al., "Capture point",
// Humanoids 2006; J. Englsberger et al., "Three-dimensional bipedal walking control based on divergent component of
// motion", 2015).
#pragma once

#include "generator/dynamics/equation_of_motion.h"
#include "generator/dynamics/possible.h"

namespace contort {

class Steering {
 public:
  // The plan must outlive it.
  void begin(const BalancePlan& plan) { plan_ = &plan; }

  // The wanted zero moment point, at a time in frames, on a target that is shifted on the ground; not bounded by any
  // support. Needs find_mass.
  Vec3 zmp_m(double frame, const Vec3& shift_m, const EquationOfMotion& equation) const;

  // The figure's capture point, at the height of its centre of mass. Needs find_mass.
  Vec3 capture_m(double frame, const EquationOfMotion& equation) const;

  // The horizontal vector from the target's capture point to the figure's, m.
  Vec3 ahead_m(double frame, const Vec3& shift_m, const EquationOfMotion& equation) const;

 private:
  const BalancePlan* plan_ = nullptr;
};

}  // namespace contort
