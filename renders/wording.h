// Numbers and names as people read them; used by pictures and pages alike.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace contort {

// With the unit that people think in beside the stored one: "-0.210 rad (-12.0 deg)", "-0.0234 m (-23.4 mm)";
// "not a number" for NaN.
std::string margin_text(double margin, std::string_view unit);

// "1.217 s" for frame 73 at 60 Hz; "" where the rate is unusable.
std::string time_text(int frame, double rate_hz);

// "1 234 567", with narrow no-break spaces.
std::string count_text(std::int64_t count);

// "1 case", "3 cases".
std::string counted(std::int64_t count, std::string_view one, std::string_view many);

// The meaning of a phase (checks/circumstances.h): "just after an interrupt" for "interrupt"; words that are not known
// stay as they are.
std::string phase_text(std::string_view phase);

// One line of valid UTF-8: control characters and broken sequences become a replacement character; where there are more
// than max_chars characters the last one is an ellipsis. Text drawing and JSON refuse or misread anything else.
std::string one_line(std::string_view text, std::size_t max_chars = static_cast<std::size_t>(-1));

}  // namespace contort
