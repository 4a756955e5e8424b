// Animations made elsewhere, as files of a library folder.
#pragma once

#include <string>

#include "model/character/library.h"
#include "model/core/result.h"

namespace contort {

// Adds every .glb, .gltf, .bvh and .amc of `folder` to `into.recordings`, by its file name without the ending. An .amc
// counts as 120 frames per second and needs its .asf beside it (formats/mocap/take.h). Codes "library.unreadable",
// "recording.duplicate_name" and those of read_gltf, read_bvh and read_take.
Result<Done> load_recordings(const std::string& folder, Library& into);

}  // namespace contort
