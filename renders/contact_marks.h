// The marks where the two solids of a finding meet: their nearest points, or the deepest ones where they overlap,
// joined.
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
inline constexpr Vec3 kContactRimColor{0.004, 0.004, 0.008};  // around it: it stands out from anything

// The points of a highlighted pair's nearest judged colliders. None without a pair, or where it has no place.
std::optional<NearestPoints> contact_of_pair(const Character& character, const Highlight& highlight,
                                             std::span<const Rigid> world);

// The points of a single highlighted solid and the obstacle that it is nearest to, or deepest in.
std::optional<NearestPoints> contact_with_obstacle(const Character& character, const Environment& environment,
                                                   const Highlight& highlight, std::span<const Rigid> world);

// A dot at either point and a line between them, over all that is in front. `figure_m` is how large the figure is: the
// dots are as large in the picture of a dog as in that of a giant.
void add_contact_mark(const NearestPoints& contact, double figure_m, DrawList& list, std::vector<Triangles>& meshes);

}  // namespace contort
