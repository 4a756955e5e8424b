// The model files that a guest's manifest names (docs/reference/guests.md).
#pragma once

#include <string>

#include "guest/manifest.h"

namespace contort::cli {

// Reads models for the manifest of the program that this command starts. A relative path is searched for in the folder
// of each file that the command names, such as the program and its settings, in their order, and then in the present
// folder. Codes generator.no_model, generator.too_many_joints, and those of the readers of files and of import_model.
ModelReader model_reader(const std::string& command);

}  // namespace contort::cli
