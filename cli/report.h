// The report of a corpus, as a page and for CI.
#pragma once

#include <string>

#include "cli/commands.h"
#include "cli/outputs.h"

namespace contort::cli {

struct ReportRequest {
  std::string corpus;
  std::string folder;       // of the page; "" for none
  std::string single_file;  // the page with all that lies beside it, in one file; "" for none
  bool announce = true;     // print where it is
  OutputRequest outputs{};  // for CI
  bool gate = false;        // exit with 1 where something gates
};

// Writes what CI reads first, then the page, and the pictures after it, so that no picture can cost a finding.
void make_report(const ReportRequest& request, Generator& generator, Context& context);

}  // namespace contort::cli
