// Reads one description of any kind into a library.
#pragma once

#include <string_view>

#include "model/character/library.h"
#include "model/core/result.h"

namespace contort {

// Adds a part, an object, a character or an action; the kind follows from its "format". Codes of the parsers in
// library.h; *.duplicate_name; library.wrong_format.
Result<Done> add_description(std::string_view json, Library& into);

}  // namespace contort
