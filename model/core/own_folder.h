// Folders that a user names for a program to fill: none that holds somebody's other files is filled by mistake.
#pragma once

#include <string>

#include "model/core/result.h"

namespace contort {

// Code folder.other_files where the folder holds files, hidden ones aside, and `is_ours` says that they are not of the
// kind that is to be added to: `kind` is that kind, "a corpus". A new folder and an empty one are fine.
Result<Done> check_own_folder(const std::string& folder, bool is_ours, const std::string& kind);

}  // namespace contort
