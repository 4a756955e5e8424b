// Writes text into a page. All text between tags and in attributes must go through these functions.
#pragma once

#include <string>
#include <string_view>

namespace contort {

// Returns text that is safe between tags and inside quoted attributes, as one line. Control characters and broken
// UTF-8 are replaced.
std::string html_text(std::string_view text);

// Returns text that is safe like that of html_text(), but with line breaks.
std::string html_lines(std::string_view text);

// Returns a relative path as a URL that stays below the page's folder, ready for a quoted attribute; "" for paths that
// leave it ("../x", "/x").
std::string html_url(std::string_view relative_path);

}  // namespace contort
