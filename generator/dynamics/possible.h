// A target that physics allows. In motions of actions and recordings the hips are where they look right, but the ground
// can only push up under a standing sole. Here the root is moved aside until the zero moment point stays under the
// feet, and the legs follow, so that every sole stays in place.
//
// To first order a shift u of the whole body changes the moment about a point p of the ground by m h u'' - f u, where f
// is the vertical force and h the height of the centre of mass: a linear inverted pendulum (S. Kajita et al., "Biped
// walking pattern generation by using preview control of zero-moment point", ICRA 2003). The bounded shift that removes
// the target's excess is the solution of a tridiagonal system over all frames. The rest is removed by repeating this
// with the changed motion, as in that paper's second stage.
#pragma once

#include <vector>

#include "generator/dynamics/contact_plan.h"

namespace contort {

// The balance of a target, by frame, by which a figure that follows it steers.
struct BalancePlan {
  std::vector<Vec3> com_m;    // centre of mass
  std::vector<Vec3> com_m_s;  // its velocity
  std::vector<Vec3> zmp_m;    // zero moment point; under the centre of mass in flight
};

// Moves root and legs of a motion. The figure counts without its loads, which targets ignore. If legs or ground cannot
// bear the motion, it comes nearer to standing (retreat.h). A possible motion stays unchanged, bit by bit.
BalancePlan make_possible(const Character& character, const DynamicFigure& figure, std::span<const double> easy,
                          const ContactPlan& plan, int ticks_per_frame, Motion& motion);

}  // namespace contort
