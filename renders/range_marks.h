// The range of a joint around it, where a joint left its range.
#pragma once

#include <span>
#include <vector>

#include "model/character/character.h"
#include "renders/draw_list.h"

namespace contort {

inline constexpr double kLeastRange_m = 0.08;  // radius of what is drawn, by the length of the limb
inline constexpr double kMostRange_m = 0.35;

// For a hinge, draws the sector that the limb may turn through, green and translucent, and in red what it has turned
// beyond that. Of a ball, the cone of its swing. Nothing of other joints, nor where a place is not finite. `world`:
// world_from_joint; `row`: the posture's coordinates.
void add_range_mark(const Character& character, int joint, std::span<const Rigid> world, std::span<const double> row,
                    DrawList& list, std::vector<Triangles>& meshes);

}  // namespace contort
