// The words of a report, each with one meaning everywhere. The page explains each word where it occurs, and all of them
// in a list at its end.
#pragma once

#include <string>
#include <string_view>

namespace contort {

// Returns the meaning of a word of the glossary in one or two sentences; "" for any other word.
std::string_view meaning_of(std::string_view word);

// Returns `text`, explained by the meaning of `word`, as an <abbr> with a title; only `text` if the word is not in the
// glossary.
std::string term_html(std::string_view word, std::string_view text);
inline std::string term_html(std::string_view word) { return term_html(word, word); }

// Returns the whole glossary as a list that the reader can unfold.
std::string glossary_html();

}  // namespace contort
