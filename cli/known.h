// Checks whether the rules of a corpus predict that a spec fails (docs/reference/conditions.md).
#pragma once

#include <string>

#include "cli/commands.h"
#include "cli/input.h"

namespace contort::cli {

// Prints each rule that holds for the spec, and sets the exit code: kFindings if there is one. Makes no motion.
void check_known(const SpecInput& input, const std::string& corpus, bool as_json, Context& context);

}  // namespace contort::cli
