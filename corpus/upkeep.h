// Maintenance of a whole corpus. Each function takes the corpus' lock and returns its changes, one line each. Buckets
// that left_alone() lists are not touched.
#pragma once

#include <string>
#include <vector>

#include "corpus/corpus.h"

namespace contort {

using Changes = std::vector<std::string>;

// Renames buckets by the present rules, from their minimal cases, and moves their folders. Buckets that become equal
// are merged.
Result<Changes> rekey(const Corpus& corpus);

// Counts buckets that were named by other rules than the present ones: a failure that is found again gets another
// bucket until `rekey`. Buckets that cannot be read are not counted.
int named_by_other_rules(const Corpus& corpus);

// Deletes the original cases of fixed buckets: min and worst are enough to notice a regression.
Result<Changes> prune(const Corpus& corpus);

// The reasons why these functions do not touch some buckets: a name or a link leads out of them (is_untrusted). Any
// other damage stops the functions before anything is changed.
std::vector<Issue> left_alone(const Corpus& corpus);

// Reads every bucket and case and writes it in the present format.
Result<Changes> migrate(const Corpus& corpus);

}  // namespace contort
