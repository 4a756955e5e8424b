// The name that somebody probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace contort {

// The number of letters that have to be put in, left out, replaced or swapped with the next one to make one word of the
// other, whatever their case.
int letters_apart(std::string_view a, std::string_view b);

// The nearest of the words, where no more than a third of its letters differ; "" where none is so near.
std::string nearest(std::string_view word, std::span<const std::string> known);

// "; did you mean \"check\"?", or "" where no name is near, for the end of a message. The names are as messages list
// them, quoted or not: "check, fuzz, replay".
std::string did_you_mean(std::string_view word, std::string_view names);

}  // namespace contort
