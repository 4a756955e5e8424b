// Checks folders into which files of a library are written.
#pragma once

#include <string>

#include "model/core/result.h"

namespace contort::cli {

// Code folder.other_files if the folder has files, but none of a library: no description (*.json with a "format" of
// contort's), no animation and no table.
Result<Done> check_library_folder(const std::string& folder);

}  // namespace contort::cli
