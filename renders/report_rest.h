// Writes the rows for which the report's first page has no room: as data that page.js adds to the page
// (docs/reference/report.md), and as a plain list for browsers without scripts.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renders/report_cards.h"

namespace contort {

// Returns the number of files that row_scripts() makes.
std::size_t row_script_count(const std::vector<LateCard>& late);

// Returns "rows/part-1.js" and so on, each a call of contortRows with some hundred rows.
std::vector<std::pair<std::string, std::string>> row_scripts(const std::vector<LateCard>& late);

// Returns the plain list as a page of its own, without scripts.
std::string plain_list_html(const std::string& title, const std::vector<LateCard>& late, const std::string& css);

// Removes files that an earlier report wrote and `pages` does not contain. Other files stay.
void remove_old_rest(const std::string& folder, const PageFiles& pages);

}  // namespace contort
