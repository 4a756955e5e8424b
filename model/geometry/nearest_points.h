// The points where two solids are nearest, for people to look at: the distance itself is model/geometry/distance.h's.
#pragma once

#include "model/geometry/distance.h"

namespace contort {

struct NearestPoints {
  Vec3 on_a_m{0.0};
  Vec3 on_b_m{0.0};
  double distance_m = 0.0;  // signed_distance of the two; NaN where they have no place, and the points mean nothing
};

// If the solids are apart: points of the surfaces that are as near as the solids are, to 0.1 mm. If they
// overlap: the deepest points, of each the one that is farthest inside of the other, so that the segment between them
// is the shortest way out. Where many are as near, as with a box on a box, the middle of them.
NearestPoints nearest_points(const Solid& a, const Solid& b);

}  // namespace contort
