// Answers questions of checks about the intent: which actions of the spec affected a part in a frame.
#pragma once

#include "checks/check.h"

namespace contort {

// The action of a span; nullptr if the intent has none.
const IntendedAction* action_of(const Intent& intent, const ActionSpan& span);

// Returns true if a span of this layer covers the part in any of the frames [first, last].
bool has_layer(const CheckInput& in, int part, Layer layer, int first, int last);

}  // namespace contort
