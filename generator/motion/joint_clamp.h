// A joint's range: clamping, and the margin of a posture inside of it. The check that judges ranges has its own
// arithmetic.
#pragma once

#include <span>

#include "model/character/character.h"
#include "model/motion/motion.h"

namespace contort {

// A ball's rotation in its limit frame: swing_center * swing * twist. The swing's rotation vector is at a right angle
// to the twist axis; a and b are its components about swing_axis and about axis x swing_axis (Grassia, "Practical
// Parameterization of Rotations Using the Exponential Map", 1998).
struct SwingTwist {
  double a_rad = 0.0;
  double b_rad = 0.0;
  double twist_rad = 0.0;  // in [-pi, pi]
};

// `coords` are the joint's own, as in a pose row: w, x, y, z.
SwingTwist swing_twist_of(const Joint& ball, const double* coords);
void set_swing_twist(const Joint& ball, const SwingTwist& at, double* coords);

// Moves the joint's coordinates into its range, and leaves them unchanged, bit by bit, if they are inside. Hinges and
// travels go to the nearer end, exactly; a ball's swing goes straight back to its ellipse and its twist to the end that
// is nearer on the circle, both 1e-9 rad inside, because a quaternion cannot hold an angle exactly. NaN goes to the
// middle of the range.
void clamp_to_range(const Joint& joint, double* coords);

// Returns true if the joint is in its range, or at most 1e-10 rad or m outside. `row` is a whole posture.
bool is_in_range(const Joint& joint, std::span<const double> row);

// Moves all joints of a part into their ranges; true if one of them was moved by more than 1e-4 rad or m.
bool clamp_part(const Character& character, std::size_t part, Posture& posture);

// The margin of the joint inside its range: 1 in the middle, 0 at a limit, below 0 outside. 1 for the root and for a
// joint that cannot move.
double normalised_margin(const Joint& joint, const double* coords);

}  // namespace contort
