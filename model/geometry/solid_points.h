// The points that span a solid's core: what of it is lowest, or farthest in any direction, is one of them plus its
// radius.
#pragma once

#include <vector>

#include "model/geometry/distance.h"

namespace contort {

// One for a point, two for a segment, eight for a box, the corners of a hull.
std::vector<Vec3> core_points(const Solid& solid);

}  // namespace contort
