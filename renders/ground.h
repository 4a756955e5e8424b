// Makes the ground's shape as triangles. A pure function of the environment and a region.
#pragma once

#include "model/character/shape.h"
#include "model/world/environment.h"

namespace contort {

struct GroundRegion {  // A rectangle in world x and z.
  double low_x_m = -1.0, low_z_m = -1.0;
  double high_x_m = 1.0, high_z_m = 1.0;
};

// A limit for every spec; a height field is sampled more coarsely to keep it.
inline constexpr int kMostGroundTriangles = 50'000;

// The ground in world coordinates. Normals point up; normals of risers point against the direction of climbing.
struct GroundMesh {
  Triangles surface;  // All of the ground except for `nosings`.
  Triangles nosings;  // The front edges of treads, a hand's width or less: they show a step seen from its upper side.
};

// Returns a mesh that covers at least the region.
GroundMesh ground_mesh(const Environment& environment, const GroundRegion& region);

}  // namespace contort
