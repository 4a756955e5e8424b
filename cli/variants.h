// The characters that a library can make, as far as they differ in the abilities of their parts.
#pragma once

#include <functional>

#include "model/character/character.h"
#include "model/character/library.h"

namespace contort::cli {

// Calls visit with every default character, then with each alternative part in its slot, and with each object at each
// socket that it is made for; but not with combinations of these.
void for_variants(const Library& library, const std::function<void(const Character&)>& visit);

}  // namespace contort::cli
