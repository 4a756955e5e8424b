// Finds the fields of a minimal spec whose values do not matter for the failure.
#pragma once

#include <string>
#include <vector>

namespace contort {

class ShrinkState;

// Returns JSON pointers into the spec. A field is free if its default, both ends and the quarters of its range, and the
// middle between value and default all fail in the same family, at any depth. A choice or a part is free if all other
// values fail. A field matters if one of these values does not fail or does not build, or if it has no other value.
std::vector<std::string> free_fields_of(ShrinkState& state);

}  // namespace contort
