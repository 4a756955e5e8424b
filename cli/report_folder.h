// The files of a report's folder, in which there may also be other people's files.
#pragma once

#include <set>
#include <string>

#include "model/core/result.h"

namespace contort::cli {

// Returns true for names that only a report uses: "<check>-<12 hex digits>", with "-<8 hex digits>" for pictures.
bool is_case_file(const std::string& name);     // .js
bool is_picture_file(const std::string& name);  // .png, .webp, and .js with the camera of a strip

// Checks that a report may be written there: code folder.other_files if the folder has files but no report.
Result<Done> check_report_folder(const std::string& folder);

// Removes the files of this kind that are not needed any more; all others stay.
void remove_old(const std::string& folder, bool (*is_ours)(const std::string&), const std::set<std::string>& wanted);

}  // namespace contort::cli
