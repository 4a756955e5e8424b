// An order of failures in which the first few are as different from one another as can be: furthest point first
// (Gonzalez 1985), as Chen et al., "Taming Compiler Fuzzers" (PLDI 2013), rank the finds of a fuzzer. Whoever looks at
// ten rows has then seen ten kinds of failure, not ten of the kind that happens to be deepest.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "renders/report.h"

namespace contort {

// By what failures are alike. Without numbers, but for who is first among equals.
struct FailureTraits {
  std::string check;
  std::string subject;
  std::string phase;
  std::string character;
  std::vector<std::string> actions;  // of the minimal spec; order and repetition mean nothing
  double depth = 0.0;                // comparable between checks
  std::string name;                  // of its own: the last word on ties
};

// A metric in [0, 1]: 0 for equal traits. Check and subject weigh most, then actions, phase and character. Subjects and
// sets of actions that share words are nearer than others.
double distance(const FailureTraits& a, const FailureTraits& b);

// Indices of `all`. The deepest comes first; each next one is furthest from its nearest before it, the deeper one of
// equals, then by name. After `most` of them, as nobody reads on for variety, the rest by depth: all of it takes time
// as most * all.size().
std::vector<std::size_t> furthest_first(std::span<const FailureTraits> all, std::size_t most);

// Rows as the report shows them: families with a row that gates, then those with a new or open one, then the others;
// within each of these groups families furthest first; within a family what gates, then by depth.
void order_rows(std::vector<ReportRow>& rows);

}  // namespace contort
