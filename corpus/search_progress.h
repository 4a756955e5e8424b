// The progress of a search, and what it leaves unseen: from the records of its runs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "corpus/runs.h"

namespace contort {

// The results of one way of drawing cases.
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
  std::int64_t lone_cases = 0;           // those cases, each counted once: one case often shows several families
  std::vector<std::int64_t> discovered;  // after how many cases each family was met first, ascending, in [1, cases]
  std::vector<ArmProgress> arms;         // by name
  bool operator==(const SearchProgress&) const = default;
};

// Runs count one after another, in the order given; shards of one run count as one.
SearchProgress progress_of(std::span<const RunRecord> runs);

// The share of further cases that would show a family not met so far, [0, 1]: lone_cases / cases, as the chance that a
// case shows what all others do not is about the same for the next one (Good, "The population frequencies of species",
// Biometrika 40, 1953; for fuzzers Böhme, "STADS", TOSEM 27, 2018). Where there is no such case, and above all where
// none failed, 3 / cases: more would have shown something with 95 % confidence (Hanley and Lippman-Hand, JAMA 249,
// 1983). Both are for cases that are drawn independently; guided ones are not, which makes it an estimate.
double unseen_share(const SearchProgress& progress);

}  // namespace contort
