// Animations made elsewhere, as files of a library folder.
#pragma once

#include <string>

#include "model/character/library.h"
#include "model/core/result.h"

namespace contort {

// Adds every .glb, .gltf and .bvh of `folder` to `into.recordings`, by its file name without the ending. Codes
// "library.unreadable", "recording.duplicate_name" and those of read_gltf and read_bvh.
Result<Done> load_recordings(const std::string& folder, Library& into);

}  // namespace contort
