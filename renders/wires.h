// Shapes as the wires that show their form and hide little.
#pragma once

#include "model/character/shape.h"

namespace contort {

// A sphere has three circles; a capsule has a circle at either end and four lines along it, closed over the ends; of a
// box or hull its edges. `radius_m` > 0 is the wire's own.
Triangles wire_triangles(const ColliderShape& shape, double radius_m);

}  // namespace contort
