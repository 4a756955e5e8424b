// Marks the contact of the two solids of a finding: their nearest points, or the deepest ones if they overlap, joined
// by a line.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/character/character.h"
#include "model/geometry/nearest_points.h"
#include "model/world/environment.h"
#include "renders/draw_list.h"

namespace contort {

inline constexpr Vec3 kContactColor{1.0, 0.93, 0.05};
inline constexpr Vec3 kContactRimColor{0.004, 0.004, 0.008};  // a rim around the mark, so that it stands out from any
                                                              // background

// Returns the points of a highlighted pair's nearest judged colliders. Returns nothing if there is no pair, or if a
// transform is not finite.
std::optional<NearestPoints> contact_of_pair(const Character& character, const Highlight& highlight,
                                             std::span<const Rigid> world);

// Returns the points of a single highlighted solid and of the nearest obstacle, or of the obstacle in which it is
// deepest.
std::optional<NearestPoints> contact_with_obstacle(const Character& character, const Environment& environment,
                                                   const Highlight& highlight, std::span<const Rigid> world);

// Adds a dot at each point and a line between them, in front of everything. `figure_m` is the size of the figure; the
// dots scale with it.
void add_contact_mark(const NearestPoints& contact, double figure_m, DrawList& list, std::vector<Triangles>& meshes);

}  // namespace contort
