// How far a search got, and what it leaves unseen: from the records of its runs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "corpus/runs.h"

namespace contort {

// What one way of drawing cases found.
struct ArmProgress {
  std::string name;            // "uniform", "guided"
  std::int64_t cases = 0;      // that it drew
  std::int64_t failing = 0;    // of these with at least one finding
  std::int64_t families = 0;   // that it met before any other did
  bool operator==(const ArmProgress&) const = default;
};

struct SearchProgress {
  std::int64_t cases = 0;
  std::int64_t failing = 0;
  std::int64_t met_once = 0;             // families that a single case showed
  std::vector<std::int64_t> discovered;  // after how many cases each family was met first, ascending, in [1, cases]
  std::vector<ArmProgress> arms;         // by name
  bool operator==(const SearchProgress&) const = default;
};

// Runs count one after another, in the order given; shards of one run count as one.
SearchProgress progress_of(std::span<const RunRecord> runs);

// The share of further cases that would show a family not met so far, [0, 1]: met_once / cases (Good, "The population
// frequencies of species", Biometrika 40, 1953; for fuzzers Böhme, "STADS", TOSEM 27, 2018). Where no family was met by
// a single case, the bound that holds with 95 % confidence: 3 / cases (Hanley and Lippman-Hand, JAMA 249, 1983). Both
// are for cases that are drawn independently; guided ones are not, which makes it an estimate.
double unseen_share(const SearchProgress& progress);

}  // namespace contort
