// Transcendental functions with the same bits on every IEEE-754 machine. glibc picks its code by CPU, so std::sin and
// friends change their last bits with the processor; these use only + - * / sqrt and floor, in a fixed order, and the
// project is built with -ffp-contract=off. They are the only ones that the product may call.
//
// Errors below are absolute, measured against long double on 10^7 arguments (tests/core/detmath_test.cpp keeps them).
#pragma once

#include <span>

namespace contort::det {

struct SinCos {
  double sin;
  double cos;
};

// |error| <= 5e-16 for |x| <= 1e4 rad. Beyond 1e9 rad, and for infinities and NaN, both are NaN: such an angle is a
// fault that must be found, so it is not wrapped.
SinCos sincos(double x_rad);
// Computes sincos of each angle, with the same bits and in less time.
void sincos(std::span<const double> x_rad, std::span<SinCos> out);
double sin(double x_rad);
double cos(double x_rad);

// Angle of the point (x, y), in [-pi, pi]; atan2(0, 0) is 0. |error| <= 5e-16 rad. NaN in, NaN out.
double atan2(double y, double x);

// Arguments outside [-1, 1] are clamped, so rounding never gives NaN. |error| <= 1e-15 rad. NaN gives NaN.
double acos(double x);
double asin(double x);

// e^x, relative error <= 5e-16 for |x| <= 700; subnormal from -708.4 down to -745.13, then 0; infinity above 709.78.
double exp(double x);

}  // namespace contort::det
