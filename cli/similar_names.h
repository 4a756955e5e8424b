// Files name the same joint with other prefixes: mixamorig:Hips, mixamorig1:Hips, mixamorigHips,
// Armature|mixamorig:Hips, Hips. A map with one of these names also applies to the others.
#pragma once

#include <map>
#include <string>

#include "model/asset/asset.h"

namespace contort::cli {

// Maps nodes of the file to names of the map (node -> joint) from which they differ only by a prefix. Empty if the file
// has one of the names itself, or if fewer than half of them, or fewer than two, are found with the same prefix.
std::map<std::string, std::string> similar_names(const Asset& asset, const std::map<std::string, std::string>& joints);

}  // namespace contort::cli
