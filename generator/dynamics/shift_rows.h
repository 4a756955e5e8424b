// The sideways shift of a whole figure that moves its zero moment point: a linear inverted pendulum (possible.h).
#pragma once

#include <span>

#include "model/core/math.h"

namespace contort {

// m h u'' - f u = ask, the condition on a frame's shift u, for both horizontal axes.
struct ShiftRow {
  double spread = 0.0;  // m h rate^2, for differences between frames
  double pressure_N = 0.0;
  Vec3 ask{0.0};
};

// One side of a motion. Beyond it the shift comes to its value at rest like a pendulum.
struct ShiftEnd {
  double rate = 0.0;   // by which share of itself the rest of the way falls within a frame
  Vec3 rest_m{0.0};
};

// Solves the rows of all frames for bounded shifts, m. The rows are changed.
void solve_shift(std::span<ShiftRow> rows, const ShiftEnd& before, const ShiftEnd& after, std::span<Vec3> shift_m);

}  // namespace contort
