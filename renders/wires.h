// Draws shapes as wires that show their form and hide little.
#pragma once

#include "model/character/shape.h"

namespace contort {

// Returns the wires of a shape: three circles of a sphere; a circle at each end and four closed lines along a capsule;
// the edges of a box or hull. `radius_m` > 0 is the wire's radius.
Triangles wire_triangles(const ColliderShape& shape, double radius_m);

}  // namespace contort
