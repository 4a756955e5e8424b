// The lifts of a target's feet that are no steps: those of a leg that reaches, kicks or is hit, and lands where it was.
#pragma once

#include <vector>

#include "generator/dynamics/contact_plan.h"
#include "model/motion/legs.h"

namespace contort {

struct FootLift {
  int sole = 0;
  int first = 0;  // first frame in the air
  int last = 0;
  Rigid from;     // where the sole leaves the ground; its first place if it never stands before
  Rigid to;       // where it lands
};

// Returns all lifts, ordered by sole and then by frame.
std::vector<FootLift> foot_lifts(const ContactPlan& plan, int soles);

// Keeps feet that bear the figure flat on the ground while another foot is lifted, if they would return to their place:
// one of two, three of four. If two feet are lifted, the one with the shorter time in the air stays.
void keep_enough_feet(const Character& character, std::span<const Leg> legs, const DynamicFigure& figure,
                      const Environment& environment, Motion& motion);

}  // namespace contort
