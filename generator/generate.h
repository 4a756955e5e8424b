// Stage to Motion: per frame the part animations, in the order of the slots from the root outward, and from them the
// whole character's.
//
// On each part the latest started ik action wins over the latest started overwrite action, which wins over what was
// there before (a posture that was reached is held). In the very frame of its start an action has nothing to move yet:
// one that still has the part then, keeps it for that frame, and so arrives where the next one starts. An action moves
// its part from the posture in which it took over to its target posture along the minimum-jerk ease; one that takes
// over again after another had the part starts from there.
#pragma once

#include "generator/motion/motion.h"
#include "generator/stage.h"

namespace contort {

// Memory that generate() reuses from call to call; any Stage may follow any other.
struct GenerateScratch {
  struct Control {    // of one part
    int action = -1;  // who moves it now, index into Timeline::actions
    double eased_at_gain = 0.0;
    int span = -1;  // its entry in Motion::spans
  };
  std::vector<Control> control;
  std::vector<double> from;    // row: the posture in which each part's action took over
  std::vector<double> target;  // row: the posture that it goes to
  std::vector<Rigid> world;
};

// Cannot fail: trouble shows in the motion (a NaN is a finding, not an abort). Overwrites `motion`.
void generate(const Stage& stage, GenerateScratch& scratch, Motion& motion);
Motion generate(const Stage& stage);

}  // namespace contort
