// Suggests the name that a user probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace contort {

// Returns the number of edits between two words, ignoring case: letters that are inserted, deleted, replaced or swapped
// with the next one.
int letters_apart(std::string_view a, std::string_view b);

// Returns the nearest of the words, if at most a third of its letters differ; otherwise "".
std::string nearest(std::string_view word, std::span<const std::string> known);

// Returns "; did you mean \"check\"?", or "" if no name is near, for the end of a message. The names are as messages
// list them, quoted or not: "check, fuzz, replay".
std::string did_you_mean(std::string_view word, std::string_view names);

}  // namespace contort
