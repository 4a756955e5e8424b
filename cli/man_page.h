// The manual page contort(1), in the macros of man(7).
#pragma once

#include <span>
#include <string>

#include "cli/command_tree.h"

namespace contort::cli {

std::string man_page(std::span<const CommandEntry> commands, const std::string& version);

}  // namespace contort::cli
