// Finds the greatest turning speed of a cubic spline of quaternions between two keys.
#pragma once

#include <array>

#include "model/core/math.h"

namespace contort {

// The spline's Bezier points as x y z w; values between them are normalised, as glTF requires (appendix C).
using BezierTurn = std::array<std::array<double, 4>, 4>;

struct SplinePeak {
  double fraction = 0.0;  // fraction of the way from the first key to the second
  double turn_rad = 0.0;  // the speed at that fraction, in rad per key interval
};

// Returns the fastest moment, at most 1 % slower than the true peak; it stops looking above `most_rad`.
//
// With q the spline and q' its derivative, a turn has the speed 2 |q ^ q'| / |q|^2, and ^ is the outer product.
// Numerator and denominator are polynomials in Bernstein's form, whose coefficients are bounds on their values. Pieces
// that may be faster than the fastest moment found so far are halved.
SplinePeak fastest_turn(const BezierTurn& spline, double most_rad);

}  // namespace contort
