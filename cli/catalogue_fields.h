// The contents of the manifests as JSON lists. Included from .cpp files only.
#pragma once

#include "model/generator.h"
#include "model/core/json_fields.h"

namespace contort::cli {

using json_fields::Json;

// Arrays of objects, each with a name and a help text.
Json list_characters(Generator& generator);
Json list_parts(Generator& generator);
Json list_actions(Generator& generator);
Json list_checks(Generator& generator);
Json list_profiles(Generator& generator);

}  // namespace contort::cli
