// Writes the part of the page that says what the cases contained, and what they never did.
#pragma once

#include <string>

#include "renders/report.h"

namespace contort {

// Returns tables of actions by slot, priority and phase, of their pairs, and of characters, parts, grounds and the
// rest. "" if nothing ran.
std::string tested_html(const ReportModel& model);

// The number of possible labels "pair …", and the number of those that were drawn.
struct PairCounts {
  std::int64_t possible = 0;
  std::int64_t drawn = 0;
};
PairCounts pair_counts(const ReportModel& model);

}  // namespace contort
