// The surroundings that all cases depend on beside their own spec.
#pragma once

#include <string>

#include "cli/commands.h"

namespace contort::cli {

// A hash of this program's own bytes, as a version says nothing while the program is worked on; of the text of
// --settings; and of every file of the library folders, which a motion or a table may come from, wherever these lie; and of the build of a program under test.
std::string surroundings_id(const Context& context, const Manifest& manifest);

}  // namespace contort::cli
