// The files that the report's viewer needs beside the page.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"

namespace contort::cli {

// A bucket whose motions the viewer can show.
struct CasePage {
  std::string key;     // file name without its ending
  std::string folder;  // the bucket's folder
  std::string minimal, original, worst;  // file names in the folder; "" without a file
  std::string strip{};                   // path of the film strip relative to the page; "" without a strip
};

// Writes DIR/cases/<key>.js for each, on all cores, and DIR/viewer. A file that the same program made from the same
// inputs is kept. If a file cannot be made, a warning is printed, and the page shows the reason in its place.
void write_case_pages(const std::vector<CasePage>& pages, const std::string& folder, Generator& generator,
                      Context& context);

}  // namespace contort::cli
