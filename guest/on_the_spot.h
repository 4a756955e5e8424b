// Clips of gaits often stay in place: an engine moves the figure while they play in a loop. Feet then slide by design.
#pragma once

#include "model/motion/execution.h"

namespace contort {

// RootPath::on_the_spot or told (finished_file.h says when). Feet are the joints that carry no other and are at rest
// within 0.15 of the root's height above the ground; they touch it within 0.03 of that height above the lowest place of
// each.
RootPath path_of(const Execution& execution);

}  // namespace contort
