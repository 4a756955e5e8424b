// Writes numbers and names for people, in pictures and pages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace contort {

// Returns a measured number for people, in the form of the page, its charts and the console: at most three significant
// digits, narrow no-break spaces between thousands, and an exponent only below 0.001 and from a million on: "-0.0234",
// "3 600", "1.5e9". "not a number" for NaN. renders/page/src/format.js has the same function, `number`.
std::string rounded_text(double value);

// Returns a margin with a second, familiar unit: "-0.21 rad (-12°)", "-0.0234 m (-23.4 mm)"; "not a number" for NaN.
std::string margin_text(double margin, std::string_view unit);

// Returns the time of a frame, such as "1.217 s" for frame 73 at 60 Hz; "" if the rate is unusable.
std::string time_text(int frame, double rate_hz);

// Returns a count such as "1 234 567", with narrow no-break spaces.
std::string count_text(std::int64_t count);

// Returns a count with its noun, such as "1 case" or "3 cases".
std::string counted(std::int64_t count, std::string_view one, std::string_view many);

// Returns a part of a whole such as "30 %", "0.4 %", "less than 0.1 %". `whole` > 0.
std::string share_text(std::int64_t part, std::int64_t whole);

// Returns the share of cases that did not fail, such as "92.6 %". Rounded down, so that "100 %" means that none failed.
// `cases` > 0.
std::string clean_share(std::int64_t cases, std::int64_t failing);

// Returns the meaning of a phase (checks/circumstances.h): "just after an interrupt" for "interrupt". Unknown words
// stay as they are.
std::string phase_text(std::string_view phase);

// Returns one line of valid UTF-8, which text drawing and JSON need. Control characters and broken sequences become a
// replacement character. If there are more than max_chars characters, the last one is an ellipsis.
std::string one_line(std::string_view text, std::size_t max_chars = static_cast<std::size_t>(-1));

}  // namespace contort
