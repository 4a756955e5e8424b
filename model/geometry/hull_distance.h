// Distance between a convex hull and any other shape, for model/geometry/distance.h.
#pragma once

#include "model/geometry/distance.h"

namespace contort {

// Returns the distance of the cores, without radii. `a` must be a hull. The band is that of signed_distance.
double hull_distance(const Solid& a, const Solid& b, double band_m);

}  // namespace contort
