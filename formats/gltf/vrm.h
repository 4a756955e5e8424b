// Reads the humanoid map of VRM files, which are glTF files that name the node of each bone of a person.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

// Returns a map from bones ("leftUpperArm") to nodes: from the extension VRMC_vrm of VRM 1, or VRM of version 0;
// empty without either. The text has passed check_document. Codes gltf.wrong_type, .bad_index, .too_large.
Result<std::map<std::string, int>> read_humanoid(std::string_view json, std::size_t node_count);

}  // namespace contort
