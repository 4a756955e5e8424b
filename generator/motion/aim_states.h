// The postures that an aim table is made from: every joint of a chain stepped through its range.
#pragma once

#include <vector>

#include "generator/motion/aim_chain.h"

namespace contort {

struct AimTableOptions {
  double joint_step_deg = 5.0;  // in [0.5, 90]; the wanted step, made coarser until there are few enough states
  int max_states = 40000;       // in [1, 4,000,000]: greatest number of postures that are examined
  int per_cell = 6;  // in [1, 16]: greatest number of postures that are kept for each direction, see aim_table.h
  bool operator==(const AimTableOptions&) const = default;
};

// The sampled values of one joint, coord_size doubles each. Hinges: evenly from end to end, at most a step apart.
// Balls: rings of swings, from the middle to the ellipse itself, at most a step apart along its longer half axis, with
// 6 k swings on the k-th ring; each with every twist from end to end. A travel has one value, the nearest to rest,
// because it turns nothing.
std::vector<double> places_of(const Joint& joint, double step_rad);

// The single value in the middle of the joint's range.
std::vector<double> middle_of(const Joint& joint);

struct AimSteps {
  double step_rad = 0.0;                    // The step that is used.
  std::vector<std::vector<double>> places;  // per joint of the chain
  int state_count = 0;                      // <= max_states: the product of the joints' numbers of places
};

// All joints are coarsened alike: the step is 1, 1.25, 1.5 … times the wanted one, the first with at most max_states
// states. If steps of 180 degrees still give too many, the joints nearest to the body stay in the middle of their
// ranges; as few of them as necessary.
AimSteps aim_steps(const AimGeometry& geometry, const AimTableOptions& options);

}  // namespace contort
