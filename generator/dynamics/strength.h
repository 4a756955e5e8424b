// Strength (seed D5): joints have no more effort than their limits. Where accelerations would need more, all of them
// are taken back together along the way to the accelerations of holding still, as far as the first limit asks: one
// joint alone cannot be taken back where legs form a closed chain.
#pragma once

#include <span>

#include "generator/dynamics/figure.h"

namespace contort {

// The largest share in [0, 1] of the way from `hold` to `efforts` at which no joint needs more than it has. 0 where
// holding still needs too much already.
double affordable_share(const DynamicFigure& figure, std::span<const double> hold, std::span<const double> efforts);

// Whether any joint needs more than it has, by more than rounding.
bool exceeds_strength(const DynamicFigure& figure, std::span<const double> efforts);

// The freedom whose effort is the greatest share of its limit, and that share; -1 and 0 where there is no effort.
struct Overload {
  int dof = -1;
  double share = 0.0;
};
Overload greatest_share(const DynamicFigure& figure, std::span<const double> efforts);

// Every effort into its limits; 0 for the root.
void clamp_to_strength(const DynamicFigure& figure, std::span<double> efforts);

}  // namespace contort
