// One tree of bones, parents first, from the trees that a file has.
#pragma once

#include "import/figure.h"

namespace contort {

// Feet that hang on no leg are hung on the nearest one of their side, and other trees on the root, which is that of the
// most points. A root that owns no points and carries a single bone is a handle, and taken out. Each guess is noted.
// The figure has a bone.
void make_one_tree(RiggedFigure& figure);

}  // namespace contort
