// The lifts of a target's feet that are no steps: of a leg that reaches, kicks or is struck, and comes down where it was.
#pragma once

#include <vector>

#include "generator/dynamics/contact_plan.h"
#include "model/motion/legs.h"

namespace contort {

struct FootLift {
  int sole = 0;
  int first = 0;  // frames in the air
  int last = 0;
  Rigid from;     // where the sole leaves the ground; where it is first, if it never stands before
  Rigid to;       // where it lands
};

// By sole, then by frame.
std::vector<FootLift> foot_lifts(const ContactPlan& plan, int soles);

// Keeps feet flat on the ground that bear the figure while another foot is lifted, as far as they would come back to
// their place: one of two, three of four. If two feet are lifted, the one that is in the air for less time stays.
void keep_enough_feet(const Character& character, std::span<const Leg> legs, const DynamicFigure& figure,
                      const Environment& environment, Motion& motion);

}  // namespace contort
