// Writes the script that lets a report play specs in the page (docs/internals/wasm.md).
#pragma once

#include <string>

#include "cli/commands.h"
#include "model/character/library.h"
#include "model/core/result.h"

namespace contort::cli {

// Returns the script library.js: the library's descriptions except for the stock ones, and the settings of checks.
// Codes of files.
Result<std::string> library_script(const Library& library, const Context& context);

}  // namespace contort::cli
