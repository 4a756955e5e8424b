// Which fields of a minimal spec could as well have other values.
#pragma once

#include <string>
#include <vector>

#include "generator/character/library.h"

namespace contort {

class ShrinkState;

// JSON pointers into the spec. A field is free if three other legal values of it fail in the same family, however deep:
// the ends of its range and something between; for a choice or a part, others that are allowed. One that refuses any of
// them, or has none, matters.
std::vector<std::string> free_fields_of(ShrinkState& state, const Library& library);

}  // namespace contort
