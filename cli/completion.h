// Scripts that make shells complete the commands and options of contort.
#pragma once

#include <span>
#include <string>

#include "cli/command_tree.h"

namespace contort::cli {

std::string bash_completion(std::span<const CommandEntry> commands);
std::string zsh_completion(std::span<const CommandEntry> commands);
std::string fish_completion(std::span<const CommandEntry> commands);

}  // namespace contort::cli
