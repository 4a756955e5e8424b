// The order in which parts are moved in each frame.
#pragma once

#include "generator/timeline/timeline.h"

namespace contort {

// Fills Timeline::part_order: carriers first, and a part that an action reads before the part that it moves. Code
// spec.circular_hold.
Result<Done> order_parts(const Character& character, Timeline& out);

}  // namespace contort
