// Clips of gaits often stay in place: an engine moves the figure while they play in a loop. Feet then slide by design.
#pragma once

#include "model/motion/execution.h"

namespace contort {

// Returns RootPath::on_the_spot or told (finished_file.h has the conditions). Feet are the joints without children
// whose height at rest is at most 0.15 of the root's height. A foot touches the ground within 0.03 of that height above
// its own lowest place.
RootPath path_of(const Execution& execution);

}  // namespace contort
