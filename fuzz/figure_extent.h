// The reach of a figure to its sides.
#pragma once

#include "model/character/character.h"

namespace contort {

// The distance from the middle of the figure at rest to its outermost point on a side, m: +1 is its left.
double extent_m(const Character& character, double side);

}  // namespace contort
