// Replays the stored cases of a bucket to find out whether they still fail. `contort replay CORPUS` does this bucket by
// bucket.
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
  Family family;  // empty if the case cannot be read
  Replay result;
};

struct BucketReplay {
  Bucket bucket;
  Shown shown = Shown::refused;
  std::vector<CaseReplay> cases;
  Verdict verdict = Verdict::refused;  // the most informative verdict among the cases that decide `shown`
};

// Runs all cases of a bucket. A case with a different result runs a second time, to tell a change from chance; cases
// of a flaky bucket run three times.
BucketReplay replay_bucket(const Corpus& corpus, const Bucket& bucket, const RunCase& run);

// Sorts buckets for replay: regressed, new, quarantined, open, flaky, invalid, fixed; within a state by name.
std::vector<Bucket> replay_order(std::vector<Bucket> buckets);

// Sorts buckets for a replay with limited time. The states take turns, in the same order, so that no state waits for
// all buckets of another. The order within a state differs from day to day.
std::vector<Bucket> replay_order_of_day(std::vector<Bucket> buckets, const std::string& day);

// Returns true if the bucket may be skipped when the time is up. Quarantined buckets always run, because a quarantine
// must not hide that a failure has become another one.
bool may_skip(const Bucket& bucket);

}  // namespace contort
