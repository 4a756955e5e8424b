// The part of the page that says what the cases were made of, and what they never were.
#pragma once

#include <string>

#include "renders/report.h"

namespace contort {

// Actions by slot, priority and phase; pairs of them; characters, parts, grounds and the rest. "" where nothing ran.
std::string tested_html(const ReportModel& model);

// Labels "pair …": how many are possible, and how many of these were drawn.
struct PairCounts {
  std::int64_t possible = 0;
  std::int64_t drawn = 0;
};
PairCounts pair_counts(const ReportModel& model);

}  // namespace contort
