// Which bone is what: families say what names mean, chains say which is the upper one.
#pragma once

#include "import/figure.h"

namespace contort {

// Fills roles, is_humanoid and is_quadruped.
void find_roles(RiggedFigure& figure);

// The bone of that role right below, on the same side; -1 where there is none.
int child_of_role(const RiggedFigure& figure, int bone, BoneRole role);

// The end of a bone: its child in the chain, else the middle of its other children, else the far end of its vertices.
Vec3 end_of(const RiggedFigure& figure, int bone);

// From a bone's position to its end; the direction is +Y where it has no length.
Vec3 direction_of(const RiggedFigure& figure, int bone);

// The lowest vertex of a bone and of everything below it, from the root.
double lowest_below_m(const RiggedFigure& figure, int bone);

}  // namespace contort
