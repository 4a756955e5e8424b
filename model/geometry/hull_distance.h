// Distance of a convex hull from any core, the hull's part of model/geometry/distance.h.
#pragma once

#include "model/geometry/distance.h"

namespace contort {

// The distance of the cores, radii left out; a.core is hull. With a band as in signed_distance.
double hull_distance(const Solid& a, const Solid& b, double band_m);

}  // namespace contort
