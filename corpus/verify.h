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
  Family family;  // empty where the case cannot be read
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

// Regressed, new, quarantined, open, flaky, invalid, fixed; within a state by name.
std::vector<Bucket> replay_order(std::vector<Bucket> buckets);

// For a slice of time that may not reach all: the states take turns, in the same order, so that none waits for all of
// another; within a state the order is another one for each day.
std::vector<Bucket> replay_order_of_day(std::vector<Bucket> buckets, const std::string& day);

// Quarantined ones always run: a quarantine must not hide that a failure has become another.
bool may_skip(const Bucket& bucket);

}  // namespace contort
