// Finds the fields of a minimal spec that could as well have other values.
#pragma once

#include <string>
#include <vector>

namespace contort {

class ShrinkState;

// JSON pointers into the spec. A field is free if its default, both ends and the quarters of its range, and what is half
// way to the default fail in the same family, however deep; of a choice or a part, all others that there are. One of
// which any of them does not fail, or does not build, or which has none, matters.
std::vector<std::string> free_fields_of(ShrinkState& state);

}  // namespace contort
