// The movement of a clip that its motion on a character leaves out, on the terminal.
#pragma once

#include <string>

#include "cli/clip_report.h"

namespace contort::cli {

// Warns of turns that are so large that another motion than the file's was judged. Nothing for a table.
void print_large_turns(const ClipMotion& motion);

// Everything else that was left out, and joints at rest; for a table its columns.
void print_conversion(const ClipMotion& motion);

// "; left out 12.3 deg, 0.180 m, 3 nodes", or "".
std::string left_out_text(const ClipMotion& motion);

}  // namespace contort::cli
