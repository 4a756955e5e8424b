// Prints the measured value of a failed check, with its limit.
#pragma once

#include <string>
#include <string_view>

#include "checks/measured.h"

namespace contort {

// Returns a text such as "turns 3 600 °/s, limit 733 °/s" or "slides 240 mm, limit 20 mm" in familiar units. `unit` is
// that of the check's margins.
std::string measured_text(std::string_view check, std::string_view unit, const Measured& measured);

}  // namespace contort
