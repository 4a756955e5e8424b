// Removes noise from a recorded motion: every joint and the root become their mean over time, weighted by a Gaussian,
// which delays nothing. Six hertz are usual for walking people (D. A. Winter, Biomechanics and Motor Control of Human
// Movement, 2009, ch. 3).
#pragma once

#include <vector>

#include "model/motion/motion.h"

namespace contort {

// `cutoff_hz` > 0 is the frequency of which 1 / sqrt 2 of the amplitude is left. Before the first frame and after the
// last one the motion counts as its own mirror image through that frame, so that its speed there stays.
// Removes jumps, as between the halves of a motion that was mirrored or between the cycles of a loop: where a joint or the
// root moves much faster for 0.05 s or less than around it, the way of the jump is spread over some 0.3 s. Steps between
// frames are replaced by their median over 0.1 s, and what that takes away comes back slowly.
void remove_jumps(const Character& character, Motion& motion);

// The values must not be empty. The median of vectors is the one with the least sum of distances from the others, in
// whatever direction the axes are (J. Astola et al., "Vector median filters", Proc. IEEE 78, 1990).
double median(std::vector<double> values);
Vec3 median(const std::vector<Vec3>& values);

// Returns the values, each replaced by the median of those within 0.05 s of it; less far near the ends.
std::vector<Vec3> medians(const std::vector<Vec3>& values, double rate_hz);

void low_pass(const Character& character, double cutoff_hz, Motion& motion);

}  // namespace contort
