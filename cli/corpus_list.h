// The failures of a corpus as a list for people: by cause, with the state of each.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "corpus/corpus.h"

namespace contort::cli {

struct ListedCorpus {
  const Corpus& corpus;
  std::vector<Bucket> buckets;  // that are listed
  std::string today;
  bool fold_sides = false;      // failures that differ only in left and right are one line
};

// The most severe cause comes first, with a line for each of its failures. Fixed failures have no cause any more, and
// come last, as do those whose smallest case cannot be read. The last line counts.
std::string corpus_list_text(const ListedCorpus& listed);

}  // namespace contort::cli
