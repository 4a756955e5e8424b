// Writes the part of the page that lists what the cases contained, and what never occurred in them.
#pragma once

#include <string>

#include "renders/report.h"

namespace contort {

// Returns tables of actions by slot, priority and phase, of their pairs, and of characters, parts, grounds and the
// rest, and the reasons of the generator for the cases that it refused. "" if nothing ran.
std::string tested_html(const ReportModel& model);

// Returns a bar whose length is the share of a count in the largest one.
std::string bar_html(std::int64_t count, std::int64_t largest);

// The number of possible labels "pair …", and the number of those that were drawn.
struct PairCounts {
  std::int64_t possible = 0;
  std::int64_t drawn = 0;
};
PairCounts pair_counts(const ReportModel& model);

}  // namespace contort
