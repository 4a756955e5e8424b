// The report of a corpus, as a page and for CI.
#pragma once

#include <string>

#include "cli/commands.h"
#include "cli/outputs.h"

namespace contort::cli {

struct ReportRequest {
  std::string corpus;
  std::string folder;       // folder of the page; "" for none
  std::string single_file;  // file that contains the page and all its files; "" for none
  bool announce = true;     // print the report's path
  OutputRequest outputs{};  // files for CI
  bool gate = false;        // exit with 1 if a failure gates
};

// Writes the files for CI first, then the page, then the pictures, so that an error in a picture loses no finding.
void make_report(const ReportRequest& request, Generator& generator, Context& context);

}  // namespace contort::cli
