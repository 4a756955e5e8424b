// Makes arrows from triangles.
#pragma once

#include "model/character/shape.h"
#include "model/core/math.h"

namespace contort {

// Returns an arrow from the origin along +Y, with its point at `length_m` > 0: a shaft with a cone on it. Short
// arrows are thinner.
Triangles arrow_triangles(double length_m);

// Returns world_from_mesh of such an arrow, from a point along a unit vector.
Rigid arrow_place(const Vec3& from_m, const Vec3& along);

}  // namespace contort
