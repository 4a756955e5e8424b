// Makes the table of the checks that fail on each character.
#pragma once

#include <string>

#include "renders/report.h"

namespace contort {

// Returns a section with a row for each check that fails and a column for each character: the number of failures, with
// a bar. Under the name of a character stands its number of cases. "" if there are no failures.
std::string check_table_html(const ReportModel& model);

}  // namespace contort
