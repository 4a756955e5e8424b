// What there is, from the manifests and a library, as JSON. Included from .cpp files only.
#pragma once

#include "model/character/library.h"
#include "model/core/json_fields.h"

namespace contort::cli {

using json_fields::Json;

// Arrays of objects with a name and a help each.
Json list_characters(const Library& library);
Json list_parts(const Library& library);
Json list_actions(const Library& library);
Json list_checks(const Library& library);
Json list_profiles(const Library& library);

}  // namespace contort::cli
