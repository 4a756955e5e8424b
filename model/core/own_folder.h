// Checks folders that a user names as outputs, so that a folder with other files is not filled by mistake.
#pragma once

#include <string>

#include "model/core/result.h"

namespace contort {

// Refuses a folder that has files other than hidden ones. `is_ours` is true if the present files are of the kind that
// may be added to; `kind` names it, such as "a corpus". A new or empty folder is accepted. Code folder.other_files.
Result<Done> check_own_folder(const std::string& folder, bool is_ours, const std::string& kind);

}  // namespace contort
