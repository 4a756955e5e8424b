// The report as one file, for mail.
#pragma once

#include <string>

#include "model/core/result.h"
#include "renders/report.h"

namespace contort::cli {

// Writes the page of the model with all files inside that write_page put into `folder`. Missing files are left out. So
// are files beyond the size that mail accepts, with a line on standard error.
Result<Done> write_single_file(const ReportModel& model, const std::string& folder, const std::string& path);

}  // namespace contort::cli
