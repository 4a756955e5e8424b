// Finds the points at which two solids are nearest, for display. The distance itself is in model/geometry/distance.h.
#pragma once

#include "model/geometry/distance.h"

namespace contort {

struct NearestPoints {
  Vec3 on_a_m{0.0};
  Vec3 on_b_m{0.0};
  double distance_m = 0.0;  // signed_distance of the two; NaN if a solid's coordinates are NaN; the points are then
                            // undefined
};

// Returns, if the solids are apart, points of their surfaces that are as near as the solids are, to 0.1 mm. If they
// overlap, it returns the deepest points: for each solid the point farthest inside of the other, so that the segment
// between them is the shortest way out. If many points are equally near, as with a box on a box, it returns the
// middle of them.
NearestPoints nearest_points(const Solid& a, const Solid& b);

}  // namespace contort
