// Merges corpora. Merging is a minimum in every bucket and a union of runs, so it is commutative, associative and
// idempotent: any order, grouping or repetition gives the same bytes.
//
// The shards of a run leave leads. Once all shards are there, the first failures of each family go into buckets, as
// they would have in one run, and the counts are added up.
#pragma once

#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "corpus/runs.h"

namespace contort {

struct Merged {
  std::vector<std::string> incomplete;  // "seed_7_0123abcd: shards 3, 12 of 16 are missing"
  std::vector<Issue> damaged;           // files that could not be read; the rest was merged
  int leads = 0;                        // number of leads that still wait
};

// Adds `sources` to `into`, which may be one of them. Code file.unwritable.
Result<Merged> merge(const std::vector<Corpus>& sources, const Corpus& into);

}  // namespace contort
