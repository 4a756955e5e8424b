// Writes the part of the page about the progress of the search.
#pragma once

#include <string>

#include "corpus/search_progress.h"

namespace contort {

// Returns sentences such as "The last of 5 kinds of failure was met after 900 of 2 000 cases. …", from which readers
// can estimate whether a longer search would find more. "" if no case ran.
std::string outlook(const SearchProgress& search);

// Returns these sentences, the curve of families over cases, and a row for each way of drawing. "" if no case ran.
std::string search_html(const SearchProgress& search);

}  // namespace contort
