// The way of any text into a page. Nothing else may write text between tags or into attributes.
#pragma once

#include <string>
#include <string_view>

namespace contort {

// Safe as text and inside quoted attributes. One line; control characters and broken UTF-8 are replaced.
std::string html_text(std::string_view text);

// The same, with its line breaks.
std::string html_lines(std::string_view text);

// A relative path as an URL that stays below the page's folder, ready for a quoted attribute; "" for a path that does
// not ("../x", "/x").
std::string html_url(std::string_view relative_path);

}  // namespace contort
