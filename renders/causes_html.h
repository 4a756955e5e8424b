// The causes of the failures of a report (docs/causes.md): what is wrong, in how many ways, and what matters most.
#pragma once

#include <string>

#include "renders/report.h"

namespace contort {

// Returns a section with a row for each of the most severe causes; "" if there are none. A headline is a link to the
// deepest case if the page can open that; `inside` as for report_html.
std::string causes_html(const ReportModel& model, const PageFiles& inside);

}  // namespace contort
