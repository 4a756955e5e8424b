// Computes the progress of a search, and estimates what it has not found, from the records of its runs.
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
  std::int64_t cases = 0;      // number of cases that it drew
  std::int64_t failing = 0;    // number of these with at least one finding
  std::int64_t families = 0;   // families that it found before the other ways did
  bool operator==(const ArmProgress&) const = default;
};

struct SearchProgress {
  std::int64_t cases = 0;
  std::int64_t failing = 0;
  std::int64_t met_once = 0;             // families that a single case showed
  std::int64_t lone_cases = 0;           // number of these cases; one case often shows several families
  std::vector<std::int64_t> discovered;  // for each family the number of cases until it was first found, ascending, in
                                         // [1, cases]
  std::vector<ArmProgress> arms;         // by name
  bool operator==(const SearchProgress&) const = default;
};

// Returns the progress of the runs in the given order, as one search; the shards of one run count as one run.
SearchProgress progress_of(std::span<const RunRecord> runs);

// An estimate of the fraction of further cases that would show a new family, [0, 1]. It is lone_cases / cases,
// because the chance that a case shows something that no other case does is about the same for the next one (Good,
// "The population frequencies of species", Biometrika 40, 1953; for fuzzers Böhme, "STADS", TOSEM 27, 2018). If there
// is no such case, and in particular if no case failed, it is 3 / cases: a greater fraction would have been seen with
// 95 % confidence (Hanley and Lippman-Hand, JAMA 249, 1983). Both formulas assume independent cases; guided cases are
// not independent.
double unseen_share(const SearchProgress& progress);

}  // namespace contort
