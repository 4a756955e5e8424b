// The postures that an aim table is made from: every joint of a chain stepped through its range.
#pragma once

#include <vector>

#include "generator/motion/aim_chain.h"

namespace contort {

struct AimTableOptions {
  double joint_step_deg = 5.0;  // in [0.5, 90]; the wanted step, made coarser until the states are few enough
  int max_states = 40000;       // in [1, 4,000,000]: postures that are looked at
  int per_cell = 6;             // in [1, 16]: postures that are kept for each direction, see aim_table.h
  bool operator==(const AimTableOptions&) const = default;
};

// The places of one joint, coord_size doubles each. Hinges: evenly from end to end, at most a step apart. Balls: rings
// of swings, from the middle to the ellipse itself, at most a step apart along its longer half axis, 6 k swings on the
// k-th ring; each with every twist from end to end. A travel has one place, the nearest to rest: it turns nothing.
std::vector<double> places_of(const Joint& joint, double step_rad);

// The one place in the middle of the joint's range.
std::vector<double> middle_of(const Joint& joint);

struct AimSteps {
  double step_rad = 0.0;                    // The step taken.
  std::vector<std::vector<double>> places;  // per joint of the chain
  int state_count = 0;                      // <= max_states: the product of the joints' numbers of places
};

// All joints are coarsened alike: the step is 1, 1.25, 1.5 … times the wanted one, the first with which there are at
// most max_states. Where even steps of 180 degrees give too many, the joints nearest to the body stay in the middle of
// their ranges, as few of them as it takes.
AimSteps aim_steps(const AimGeometry& geometry, const AimTableOptions& options);

}  // namespace contort
