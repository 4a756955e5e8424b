// Writes rules as a C++ header for games: known.h with the rules behind it, as constants. It needs nothing else.
#pragma once

#include <string>
#include <vector>

#include "corpus/condition.h"

namespace contort {

// The text of the header. Its first comment names the corpus, `from`.
std::string rules_header(const std::vector<Condition>& conditions, const std::string& from);

}  // namespace contort
