// The part of the page that says how far the search got.
#pragma once

#include <string>

#include "corpus/search_progress.h"

namespace contort {

// "The last of 5 families was met after 900 of 2 000 cases. …": whether going on would show more. "" where nothing ran.
std::string outlook(const SearchProgress& search);

// The same sentences, the curve of families over cases, and a row for each way of drawing. "" where nothing ran.
std::string search_html(const SearchProgress& search);

}  // namespace contort
