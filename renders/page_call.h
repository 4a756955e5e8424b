// Writes data for the page to a file beside it. Browsers let a page that is opened from a disk load only scripts, so
// the file is a script that calls a function of the page with a name and the data.
#pragma once

#include <string>
#include <string_view>

namespace contort {

// Returns JSON without characters that could end a script element or begin a comment in it.
std::string without_markup(std::string_view json);

// Returns the script. `stamp` identifies the inputs of the file, so that an unchanged file need not be made again; ""
// for none.
std::string page_call(std::string_view function, std::string_view name, const std::string& data,
                      std::string_view stamp = "");

// Returns the data, or the stamp, of such a script; "" if the text is no such file.
std::string data_of_page_call(std::string_view function, std::string_view name, std::string_view script);
std::string stamp_of_page_call(std::string_view script);

}  // namespace contort
