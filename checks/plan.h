// The intent, as checks ask for it: which of the spec's actions had a part in a frame.
#pragma once

#include "checks/check.h"

namespace contort {

// The action of a span; nullptr where the intent has none.
const IntendedAction* action_of(const Intent& intent, const ActionSpan& span);

// Whether a span of this layer covers the part in any of the frames [first, last].
bool has_layer(const CheckInput& in, int part, Layer layer, int first, int last);

}  // namespace contort
