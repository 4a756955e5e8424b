// Writes numbers and names for people, in pictures and pages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace contort {

// Returns a margin with a second, familiar unit: "-0.210 rad (-12.0 deg)", "-0.0234 m (-23.4 mm)"; "not a number" for
// NaN.
std::string margin_text(double margin, std::string_view unit);

// Returns the time of a frame, such as "1.217 s" for frame 73 at 60 Hz; "" if the rate is unusable.
std::string time_text(int frame, double rate_hz);

// Returns a count such as "1 234 567", with narrow no-break spaces.
std::string count_text(std::int64_t count);

// Returns a count with its noun, such as "1 case" or "3 cases".
std::string counted(std::int64_t count, std::string_view one, std::string_view many);

// Returns the share of cases that did not fail, such as "92.6 %". Rounded down, so that "100 %" means that none failed.
// `cases` > 0.
std::string clean_share(std::int64_t cases, std::int64_t failing);

// Returns the meaning of a phase (checks/circumstances.h): "just after an interrupt" for "interrupt". Unknown words
// stay as they are.
std::string phase_text(std::string_view phase);

// Returns one line of valid UTF-8. Control characters and broken sequences become a replacement character; if there
// are more than max_chars characters, the last one is an ellipsis. Text drawing and JSON refuse or misread anything
// else.
std::string one_line(std::string_view text, std::size_t max_chars = static_cast<std::size_t>(-1));

}  // namespace contort
