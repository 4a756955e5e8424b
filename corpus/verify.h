// Whether the stored cases of a bucket still fail: what a replay of a corpus does, bucket by bucket.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "corpus/lifecycle.h"
#include "corpus/replay.h"

namespace contort {

struct CaseReplay {
  std::string path;
  std::string family;  // "" where the case cannot be read
  Replay result;
};

struct BucketReplay {
  Bucket bucket;
  Shown shown = Shown::refused;
  std::vector<CaseReplay> cases;
  Verdict verdict = Verdict::refused;  // of the cases that decide `shown`, of which one it is worth to be told
};

// Runs all cases. One that does not show what it showed runs a second time, to tell a change from chance; those of a
// flaky bucket run three times.
BucketReplay replay_bucket(const Corpus& corpus, const Bucket& bucket, const RunCase& run);

// Regressed, new, quarantined, open, flaky, invalid, fixed. Within a state by name, or, with `shuffle`, in an order
// that is another for each text: what a short slice of time does not reach today, it reaches another day.
std::vector<Bucket> replay_order(std::vector<Bucket> buckets, const std::string& shuffle);

// Quarantined ones always run: a quarantine must not hide that a failure has become another.
bool may_skip(const Bucket& bucket);

}  // namespace contort
