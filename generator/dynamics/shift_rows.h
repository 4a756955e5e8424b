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

// Solves the rows of all frames for bounded shifts, m. Before the first frame and after the last, the condition of that
// frame continues, and the shift approaches its value at rest like a pendulum with these rates per frame. The rows are
// changed.
void solve_shift(std::span<ShiftRow> rows, double rate_before, double rate_after, std::span<Vec3> shift_m);

}  // namespace contort
