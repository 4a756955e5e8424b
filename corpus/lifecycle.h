// The states of a bucket: the table of docs/corpus.md as pure functions. No clock: days are handed in.
#pragma once

#include <string>

#include "corpus/bucket.h"
#include "model/core/result.h"

namespace contort {

// The outcome of a replay of all cases of a bucket.
enum class Shown {
  fails,     // one of them at least still fails in the bucket's family
  gone,      // none does
  unsteady,  // two runs of one of them differed
  refused,   // the specs no longer build
};

struct Observation {
  Shown shown = Shown::fails;
  std::string build;  // in which this was seen: "contort 0.1.0 abc123"
};

// Builds in which a bucket must be gone, one after the other, to count as fixed.
inline constexpr int kBuildsToFix = 2;
// Steady replays after which a flaky bucket is again what it was.
inline constexpr int kSteadyReplays = 20;
// Passes after which a quarantine is reported as needless.
inline constexpr int kStalePasses = 5;
inline constexpr int kLongestQuarantineDays = 30;

Bucket next_state(const Bucket& bucket, const Observation& seen, const std::string& today);

// Whether it fails a build: new, regressed, or quarantined until before today. The one place that says so.
bool is_gating(const Bucket& bucket, const std::string& today);

bool is_expired(const Bucket& bucket, const std::string& today);

// Quarantined, and passes all the time.
bool is_stale(const Bucket& bucket);

// Changes that people make. Codes bucket.is_fixed, bucket.no_owner, bucket.no_ticket, bucket.no_reason, bucket.no_day,
// bucket.too_long.
Result<Bucket> acknowledge(const Bucket& bucket, const std::string& owner, const std::string& ticket);
Result<Bucket> quarantine(const Bucket& bucket, const std::string& owner, const std::string& reason,
                          const std::string& expires, const std::string& today);

// "" takes the note away.
Bucket annotate(const Bucket& bucket, const std::string& note);

// If there are two copies of a bucket, the state of the one that was changed more often, with what belongs to it, goes
// to `into`. Commutative, associative, idempotent.
void merge_state(Bucket& into, const Bucket& other);

}  // namespace contort
