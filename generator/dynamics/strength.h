// Strength (seed D5): no joint has more effort than its limit. If accelerations would need more, all of them are
// reduced together towards those of holding still, until all efforts are within their limits: one joint alone cannot be
// reduced if legs form a closed chain.
#pragma once

#include <span>

#include "generator/dynamics/figure.h"

namespace contort {

// The largest fraction in [0, 1] of the way from `hold` to `efforts` at which no joint exceeds its strength. 0 if
// holding still already does.
double affordable_share(const DynamicFigure& figure, std::span<const double> hold, std::span<const double> efforts);

// Returns true if any joint needs more than its strength, by more than rounding.
bool exceeds_strength(const DynamicFigure& figure, std::span<const double> efforts);

// The degree of freedom whose effort is the greatest fraction of its limit, and that fraction; -1 and 0 without
// efforts.
struct Overload {
  int dof = -1;
  double share = 0.0;
};
Overload greatest_share(const DynamicFigure& figure, std::span<const double> efforts);

// Clamps every effort to its limits; 0 for the root.
void clamp_to_strength(const DynamicFigure& figure, std::span<double> efforts);

}  // namespace contort
