// Upkeep of a whole corpus, for now and then. Each function takes the corpus' lock and gives what it changed, one line
// each. What left_alone lists is not touched.
#pragma once

#include <string>
#include <vector>

#include "corpus/corpus.h"

namespace contort {

using Changes = std::vector<std::string>;

// Names buckets anew, by today's rules, from their minimal cases, and moves them. Two that become one are merged.
Result<Changes> rekey(const Corpus& corpus);

// Counts buckets that are named by other rules than today's: a failure that comes back gets another bucket until
// `rekey`. Those that cannot be read are not counted.
int named_by_other_rules(const Corpus& corpus);

// Drops the originals of fixed buckets: min and worst are enough to notice that one regresses.
Result<Changes> prune(const Corpus& corpus);

// Why buckets are left alone by all of these: what they name, or a link, leads out of them (is_untrusted). Any other
// damage stops them before anything is changed.
std::vector<Issue> left_alone(const Corpus& corpus);

// Reads every bucket and case and writes it in today's format.
Result<Changes> migrate(const Corpus& corpus);

}  // namespace contort
