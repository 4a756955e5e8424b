// The states of a bucket: the table of docs/reference/corpus.md as pure functions. They use no clock; dates are
// arguments.
#pragma once

#include <string>

#include "corpus/bucket.h"
#include "model/core/result.h"

namespace contort {

// The outcome of a replay of all cases of a bucket.
enum class Shown {
  fails,     // at least one case still fails in the bucket's family
  gone,      // no case fails in the bucket's family
  unsteady,  // two runs of one case differed
  refused,   // the specs no longer build
};

struct Observation {
  Shown shown = Shown::fails;
  std::string build;  // the build that was replayed: "contort 0.1.0 abc123"
};

// The number of builds in which a bucket must be gone to count as fixed.
inline constexpr int kBuildsToFix = 2;
// The number of steady replays in a row after which a flaky bucket returns to its earlier state.
inline constexpr int kSteadyReplays = 20;
// The number of passes in a row after which a quarantine is reported as unnecessary.
inline constexpr int kStalePasses = 5;
inline constexpr int kLongestQuarantineDays = 30;

Bucket next_state(const Bucket& bucket, const Observation& seen, const std::string& today);

// Returns true if the bucket fails a build: it is new, regressed, or its quarantine ended before today. Only this
// function decides that.
bool is_gating(const Bucket& bucket, const std::string& today);

bool is_expired(const Bucket& bucket, const std::string& today);

// Returns true if the bucket is quarantined and always passes.
bool is_stale(const Bucket& bucket);

// Changes by people. Codes bucket.is_fixed, bucket.no_owner, bucket.no_ticket, bucket.no_reason, bucket.no_day,
// bucket.too_long.
Result<Bucket> acknowledge(const Bucket& bucket, const std::string& owner, const std::string& ticket);
Result<Bucket> quarantine(const Bucket& bucket, const std::string& owner, const std::string& reason,
                          const std::string& expires, const std::string& today);

// Sets the note of a bucket; "" removes it.
Bucket annotate(const Bucket& bucket, const std::string& note);

// Merges the state of another copy of a bucket into `into`: the state that was changed more often wins, with its
// owner and so on. The merge is commutative, associative and idempotent.
void merge_state(Bucket& into, const Bucket& other);

}  // namespace contort
