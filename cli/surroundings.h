// The surroundings on which all cases depend, besides their own specs.
#pragma once

#include <string>

#include "cli/commands.h"

namespace contort::cli {

// Returns a hash of this program's own bytes, because the version stays the same during development; of the text of
// --settings; of every file in the library folders; and of the build of a program under test.
std::string surroundings_id(const Context& context, const Manifest& manifest);

}  // namespace contort::cli
