// contort replay --generator A --against B: runs every minimal case in both programs, and finds the first difference of
// their motions.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"

namespace contort::cli {

// Prints one line for each case of these files and corpora. The exit code is 1 if a case has another verdict in the
// other program, or another motion.
void replay_side_by_side(const std::vector<std::string>& paths, const std::string& other, Generator& generator,
                         Context& context);

}  // namespace contort::cli
