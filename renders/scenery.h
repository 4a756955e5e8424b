// Draws an environment.
#pragma once

#include <span>
#include <vector>

#include "model/world/environment.h"
#include "renders/camera.h"
#include "renders/draw_list.h"
#include "renders/ground.h"

namespace contort {

// Returns the region of all ground that is visible to a camera that frames these outlines (one for each frame), and
// not much more.
GroundRegion region_around(std::span<const std::vector<Vec3>> outlines);

// Returns probe_views() in another order: views that show best how the ground rises around `at_m` come first. Steps
// are seen from their low side, where risers are visible, and other ground from beside, where a slope is not
// foreshortened. The order does not change if the ground hardly rises.
std::vector<View> views_of(const Environment& environment, const Vec3& at_m, double radius_m);

// Appends the triangles to `meshes`. A level plane has no triangles for the ground.
Scenery make_scenery(const Environment& environment, const GroundRegion& region, std::vector<Triangles>& meshes);

}  // namespace contort
