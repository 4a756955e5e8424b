// The causes of the failures of a report (docs/reference/causes.md): a table with the most severe cause first.
#pragma once

#include <string>

#include "renders/report.h"

namespace contort {

// Returns a severity (docs/reference/causes.md) as a word: "very high" from 20 on, "high" from 5, "medium" from 1, or
// "low".
std::string severity_word(double severity);

// Returns a section with a row for each of the most severe causes; "" if there are none. A row has the worst
// frame of its deepest case; its headline is a link to that case if the page can open it. Its failures, the conditions
// under which they show, and the command that shows one again are folded away. `inside` as for report_html.
std::string causes_html(const ReportModel& model, const PageFiles& inside);

}  // namespace contort
