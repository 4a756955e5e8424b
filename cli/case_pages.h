// The files that the report's viewer needs beside the page.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"

namespace contort::cli {

// A bucket whose motions can be looked at.
struct CasePage {
  std::string key;     // file name without its end
  std::string folder;  // of the bucket
  std::string minimal, original, worst;  // file names in it; "" where there is none
  std::string strip{};                   // path of the film strip from the page; "" where there is none
};

// Writes DIR/cases/<key>.js for each, on all cores, and DIR/viewer. A file that was made of the same by the same
// program stays. What cannot be made is a warning: the page says so where somebody looks for it.
void write_case_pages(const std::vector<CasePage>& pages, const std::string& folder, Generator& generator,
                      Context& context);

}  // namespace contort::cli
