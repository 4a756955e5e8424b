// Adds the clips of other files to a model: libraries of animations come apart from the characters that they move.
#pragma once

#include "model/asset/asset.h"

namespace contort {

// Adds the clips of which at least half of the turned nodes are, by name, nodes of the model. Only turns are taken
// over: other rigs have other lengths. Returns how many clips were added.
int add_clips(const Asset& from, Asset& into);

}  // namespace contort
