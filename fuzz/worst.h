// The deepest failure that a minimal spec's structure can show: what people look at, where the minimal one is what they
// read.
#pragma once

#include "corpus/case.h"

namespace contort {

class ShrinkState;

// Climbs the depth over the numbers that survived, one at a time, by half of the way to an end of its range and then by
// less; 100 evaluations at most.
Case worst_of(ShrinkState& state);

}  // namespace contort
