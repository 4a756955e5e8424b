// Writes text into a page. Nothing else may write text between tags or into attributes.
#pragma once

#include <string>
#include <string_view>

namespace contort {

// Returns text that is safe between tags and inside quoted attributes, as one line. Control characters and broken
// UTF-8 are replaced.
std::string html_text(std::string_view text);

// Returns safe text as html_text() does, but keeps line breaks.
std::string html_lines(std::string_view text);

// Returns a relative path as a URL that stays below the page's folder, ready for a quoted attribute; "" for a path
// that does not ("../x", "/x").
std::string html_url(std::string_view relative_path);

}  // namespace contort
