// Returns the points that span a solid's core. The lowest point of a solid, or its farthest in any direction, is one
// of them plus the radius.
#pragma once

#include <vector>

#include "model/geometry/distance.h"

namespace contort {

// Returns one point for a point, two for a segment, eight for a box, and the corners of a hull.
std::vector<Vec3> core_points(const Solid& solid);

}  // namespace contort
