// Requests that the generator could not meet, as text and as JSON. They are notes and fail nothing.
#pragma once

#include <string>
#include <vector>

#include "model/motion/execution.h"

namespace contort::cli {

// One line for each: "note: reach (arm_left) was not met in frames 38-38: it is out of reach". Empty without an intent.
std::vector<std::string> unmet_lines(const Execution& made);

// One line if a blow is harder than the figure must withstand; otherwise none.
std::vector<std::string> overpowered_lines(const Execution& made);

// A JSON list: action, slot, first_frame, last_frame, why.
std::string unmet_json(const Execution& made);

}  // namespace contort::cli
