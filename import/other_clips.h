// Adds the clips of other files to a model: libraries of animations are often separate from their characters.
#pragma once

#include "model/asset/asset.h"

namespace contort {

// Adds a clip if the model has nodes with the names of at least half of the nodes that the clip rotates. Only rotations
// are taken over, because other rigs have other lengths. Returns how many clips were added.
int add_clips(const Asset& from, Asset& into);

}  // namespace contort
