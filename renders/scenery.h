// An environment as it is drawn.
#pragma once

#include <span>
#include <vector>

#include "model/world/environment.h"
#include "renders/camera.h"
#include "renders/draw_list.h"
#include "renders/ground.h"

namespace contort {

// All ground that a camera shows that frames these outlines (one per frame), and not much more.
GroundRegion region_around(std::span<const std::vector<Vec3>> outlines);

// probe_views(), with those first that show how the ground rises around `at_m`: steps from their low side, where risers
// are seen, other ground from beside, where a slope is not foreshortened. As they are where it hardly rises.
std::vector<View> views_of(const Environment& environment, const Vec3& at_m, double radius_m);

// Appends the triangles to `meshes`. On a level plane there are none for the ground.
Scenery make_scenery(const Environment& environment, const GroundRegion& region, std::vector<Triangles>& meshes);

}  // namespace contort
