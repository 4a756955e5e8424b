// Folders that files of a library are written into.
#pragma once

#include <string>

#include "model/core/result.h"

namespace contort::cli {

// Code folder.other_files where the folder holds files and none of them is of a library: no description (*.json with a
// "format" of contort's), no animation and no table.
Result<Done> check_library_folder(const std::string& folder);

}  // namespace contort::cli
