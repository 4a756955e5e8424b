// Shapes of robots' files as solids that a character can have.
#pragma once

#include <span>

#include "model/character/shape.h"

namespace contort {

// Solids along the +Z axis of a frame, centred at its origin.
ColliderShape placed_box(const Rigid& at, const Vec3& half_m);
ColliderShape placed_capsule(const Rigid& at, double radius_m, double half_length_m);   // half: of the straight part
ColliderShape placed_cylinder(const Rigid& at, double radius_m, double half_length_m);  // a prism of 16 sides
ColliderShape placed_ellipsoid(const Rigid& at, const Vec3& radii_m);

// Returns the hull of up to 62 of the points, those that lie farthest in directions spread evenly; a hull without
// points if they span no solid.
ConvexHull hull_around(std::span<const Vec3> points_m);

ColliderShape moved_shape(const Rigid& to_from_own, const ColliderShape& shape);

// Returns true if a character can have the shape: all sizes are at least 0.1 mm, and at most 100 m.
bool is_solid(const ColliderShape& shape);

}  // namespace contort
