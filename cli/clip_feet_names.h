// Finds the legs of a file's own skeleton by the names of its nodes, as an import does (import/names.h).
#pragma once

#include <vector>

#include "checks/clip_feet.h"

namespace contort::cli {

// One leg for each side, and for each pair of legs of figures with more. None if names or places do not show them.
std::vector<ClipFoot> feet_by_names(const Asset& asset);

}  // namespace contort::cli
