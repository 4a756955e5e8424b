// The failures of a corpus as a list for people: by cause, with the state of each.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "corpus/corpus.h"

namespace contort::cli {

struct ListedCorpus {
  const Corpus& corpus;
  std::vector<Bucket> buckets;  // the listed buckets
  std::string today;
  bool fold_sides = false;      // failures that differ only in left and right are one line
};

// The most severe cause comes first, with a line for each of its failures. Failures without a cause come last: fixed
// ones, and those whose minimal case cannot be read. The last line has the counts.
std::string corpus_list_text(const ListedCorpus& listed);

}  // namespace contort::cli
