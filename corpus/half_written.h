// Removes partly written files. A process that is killed between writing a file and renaming it (files.h) leaves them
// behind.
#pragma once

#include "corpus/corpus.h"
#include "corpus/runs.h"

namespace contort {

// Removes partly written files of the buckets, which nobody writes without the corpus' lock, and of this run, whose
// lock the caller holds. Leads of a run of several shards stay, because other shards may be writing theirs; fsck
// removes what is left.
Result<Done> drop_half_written(const Corpus& corpus, const RunRecord& run);

}  // namespace contort
