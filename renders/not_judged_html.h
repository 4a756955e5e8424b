// The report's lists of what a run did not judge: cases that the generator refused, requests that it could not meet,
// and checks that could not judge.
#pragma once

#include <string>

#include "renders/report.h"

namespace contort {

// Returns the lists that are not empty, each with a heading; "" if all are.
std::string not_judged_html(const ReportModel& model);

}  // namespace contort
