// Joins the trees of a file into one tree of bones, parents first.
#pragma once

#include "import/figure.h"

namespace contort {

// Attaches feet without a leg to the nearest leg of their side, and other trees to the root of the tree with the most
// points. A root without points and with a single child bone is a handle and is removed. Each guess is noted. The
// figure must have a bone.
void make_one_tree(RiggedFigure& figure);

}  // namespace contort
