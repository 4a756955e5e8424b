// contort corpus fsck, rekey, prune and migrate.
#pragma once

#include "cli/commands.h"

namespace contort::cli {

void add_upkeep(CLI::App& corpus, Context& context);

}  // namespace contort::cli
