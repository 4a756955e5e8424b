// Data for the page in a file beside it. Browsers let a page from a disk load scripts and nothing else, so such a file
// is a script that calls a function of the page with a name and the data.
#pragma once

#include <string>
#include <string_view>

namespace contort {

// JSON without signs that could end a script element or begin a comment in it.
std::string without_markup(std::string_view json);

// `stamp`: a word that says what the file was made of, for who would make it again; "" for none.
std::string page_call(std::string_view function, std::string_view name, const std::string& data,
                      std::string_view stamp = "");

// And back; "" where the text is no such file.
std::string data_of_page_call(std::string_view function, std::string_view name, std::string_view script);
std::string stamp_of_page_call(std::string_view script);

}  // namespace contort
