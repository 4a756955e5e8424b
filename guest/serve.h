// Serves one of our generators over contort.generator/1; guest_program.h is the client.
#pragma once

#include <cstdio>
#include <span>
#include <string>

#include "model/core/result.h"
#include "model/generator.h"

namespace contort {

// Answers requests for the characters until the input ends. Codes of describe().
Result<Done> serve_guest(Generator& generator, std::span<const std::string> characters, std::FILE* in, std::FILE* out);

}  // namespace contort
