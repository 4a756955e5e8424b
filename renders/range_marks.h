// Draws the range of a joint around a joint that left it.
#pragma once

#include <span>
#include <vector>

#include "model/character/character.h"
#include "renders/draw_list.h"

namespace contort {

inline constexpr double kLeastRange_m = 0.08;  // smallest radius of the drawing, which otherwise follows from the
                                               // length of the limb
inline constexpr double kMostRange_m = 0.35;
inline constexpr Vec3 kAllowedColor{0.04, 0.50, 0.09};

// Draws, for a hinge, the sector in which the limb may turn, green and translucent, and in red the angle beyond it;
// for a ball joint, the cone of its swing. Draws nothing for other joints, or if a transform is not finite. `world`:
// world_from_joint; `row`: the posture's coordinates.
void add_range_mark(const Character& character, int joint, std::span<const Rigid> world, std::span<const double> row,
                    DrawList& list, std::vector<Triangles>& meshes);

}  // namespace contort
