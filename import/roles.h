// Finds the role of each bone. Names give the family of a bone; its place in a chain decides, for example, whether it
// is the upper one.
#pragma once

#include "import/figure.h"

namespace contort {

// Fills in roles, is_humanoid and is_quadruped.
void find_roles(RiggedFigure& figure);

// Returns the child bone of that role on the same side; -1 if there is none.
int child_of_role(const RiggedFigure& figure, int bone, BoneRole role);

// Returns the end of a bone: the position of its child in the chain, else the middle of its other children, else the
// far end of its vertices.
Vec3 end_of(const RiggedFigure& figure, int bone);

// Returns the vector from a bone's position to its end; its direction is +Y if it has no length.
Vec3 direction_of(const RiggedFigure& figure, int bone);

// Returns the height, relative to the root, of the lowest vertex of a bone and of the bones that it carries.
double lowest_below_m(const RiggedFigure& figure, int bone);

}  // namespace contort
