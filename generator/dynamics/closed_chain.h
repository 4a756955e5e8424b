// Links that move together while several feet stand: the root and all links of legs. They must follow the same knots.
#pragma once

#include <vector>

#include "generator/dynamics/figure.h"

namespace contort {

std::vector<int> closed_chain(const DynamicFigure& figure);

}  // namespace contort
