// Specs with which a run begins.
#pragma once

#include <string>
#include <vector>

#include "model/generator.h"
#include "model/core/result.h"
#include "model/spec/spec.h"

namespace contort::cli {

// The specs of all specs and cases (*.json) in a folder, in the order of their names. Codes of reading them;
// seeds.none; and seeds.refused for a spec that does not build, because a run that tests nothing must not look clean.
Result<std::vector<Spec>> read_seeds(const std::string& folder, Generator& generator);

}  // namespace contort::cli
