// The part of the page that says how far the search got.
#pragma once

#include <string>

#include "corpus/search_progress.h"

namespace contort {

// A sentence, the curve of families over cases, and a row for each way of drawing. "" where nothing ran.
std::string search_html(const SearchProgress& search);

}  // namespace contort
