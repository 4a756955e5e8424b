// Finds the deepest failure that a minimal spec's structure can show. People read the minimal case, and look at this
// one.
#pragma once

#include "corpus/case.h"

namespace contort {

class ShrinkState;

// Makes the failure deeper by changing the numbers that are left, one at a time: first by half of the way to an end of
// its range, then by less. At most 100 evaluations.
Case worst_of(ShrinkState& state);

}  // namespace contort
