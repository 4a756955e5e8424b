// The HTML report of a corpus.
#pragma once

#include <string>

#include "cli/commands.h"

namespace contort::cli {

struct ReportRequest {
  std::string corpus;
  std::string folder;
  bool announce = true;  // print where it is
};

// Writes the page first and the pictures after it, so that no picture can cost a finding.
void make_report(const ReportRequest& request, const Library& library, Context& context);

// "NEW self_collision|mech|… -0.03 m  contort replay …/min-….json", for a bucket's folder.
Result<std::string> bucket_line(const std::string& bucket_folder, const std::vector<std::string>& library_folders);

}  // namespace contort::cli
