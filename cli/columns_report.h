// The columns of a table of joint values that were judged, and those that were not.
#pragma once

#include <string>
#include <vector>

#include "cli/clip_report.h"

namespace contort::cli {

// The first few names, and the number of the others.
std::string some_names(const std::vector<std::string>& names);

void print_columns(const ClipMotion& motion);        // prints lines that follow those of a clip
std::string columns_text(const ClipMotion& motion);  // "; 7 of 9 columns are joints"
std::string columns_json(const ClipMotion& motion);

}  // namespace contort::cli
