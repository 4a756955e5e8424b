// The characters that a library can make, as far as it matters what their parts can do.
#pragma once

#include <functional>

#include "model/character/character.h"
#include "model/character/library.h"

namespace contort::cli {

// Calls visit with every character as it is by default, with each part that may stand in a slot, and with each object
// at each socket that it is made for. Not with all their combinations.
void for_variants(const Library& library, const std::function<void(const Character&)>& visit);

}  // namespace contort::cli
