// Sorts failures so that the first few are as different from one another as possible: furthest point first (Gonzalez
// 1985), as Chen et al., "Taming Compiler Fuzzers" (PLDI 2013), rank the failures of a fuzzer. A reader of ten rows
// has then seen ten kinds of failure, not ten of the deepest kind.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "renders/report.h"

namespace contort {

// The traits by which failures are compared. Numbers only decide between equals.
struct FailureTraits {
  std::string check;
  std::string subject;
  std::string phase;
  std::string character;
  std::vector<std::string> actions;  // actions of the minimal spec; order and repetition mean nothing
  double depth = 0.0;                // comparable between checks
  std::string name;                  // a unique name, which decides ties
};

// A metric in [0, 1]: 0 for equal traits. Check and subject weigh most, then actions, phase and character. Subjects and
// sets of actions that share words are nearer than others.
double distance(const FailureTraits& a, const FailureTraits& b);

// Returns indices of `all`. The deepest comes first. Each next one is furthest from its nearest predecessor; of equals
// the deeper one comes first, then by name. After `most` of them the rest is sorted by depth, because sorting all takes
// time in proportion to most * all.size().
std::vector<std::size_t> furthest_first(std::span<const FailureTraits> all, std::size_t most);

// Sorts rows as the report shows them: families with a gating row, then those with a new or open one, then the
// others. Within each of these groups families are sorted furthest first; within a family gating rows come first,
// then by depth.
void order_rows(std::vector<ReportRow>& rows);

}  // namespace contort
