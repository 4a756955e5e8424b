// Starting the renderer.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"
#include "model/core/result.h"

namespace contort::cli {

// Path of contort-render, beside the running program.
std::string renderer_path();

// The start of every call of it: its path, --gl, --library and --settings.
std::vector<std::string> renderer_call(const Context& context);

}  // namespace contort::cli
