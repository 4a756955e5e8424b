// Findings as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "checks/fold.h"

namespace contort::cli {

// "self_collision  arm_left/forearm ~ torso/trunk  -0.031 m  frames 12-40, worst 20 (0.333 s)"
std::string finding_line(const Finding& finding, double rate_hz);

// A JSON list: check, subject, unit, margin (null where it is NaN), depth, frames and times.
std::string findings_json(const std::vector<Finding>& findings, double rate_hz);

// A finite number in short; "nan" where it is not one.
std::string short_number(double value);

}  // namespace contort::cli
