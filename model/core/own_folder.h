// Checks folders that a user names for a program to fill, so that no folder with somebody's other files is filled by
// mistake.
#pragma once

#include <string>

#include "model/core/result.h"

namespace contort {

// Refuses a folder that has files other than hidden ones, unless `is_ours`, which says that they are of the kind that
// may be added to. `kind` names that kind, such as "a corpus". A new or empty folder is accepted. Code
// folder.other_files.
Result<Done> check_own_folder(const std::string& folder, bool is_ours, const std::string& kind);

}  // namespace contort
