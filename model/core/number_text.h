// Prints numbers for messages.
#pragma once

#include <string>

namespace contort {

// Returns a number with at most seven digits: "1.5", "1803.22", and "1e+308" instead of 309 digits.
std::string number_text(double value);

}  // namespace contort
