// A page without scripts, in one file, in the look of the report.
#pragma once

#include <string>
#include <string_view>

namespace contort {

// `body` is markup. `own_style` follows the report's style sheet. Equal arguments give equal pages.
std::string static_page(std::string_view title, std::string_view own_style, const std::string& body);

}  // namespace contort
