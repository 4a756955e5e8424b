// The failures that are known on the branch with which a change is compared. They do not gate.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "corpus/bucket.h"
#include "corpus/causes.h"
#include "corpus/leads.h"
#include "corpus/group_counts.h"
#include "model/core/result.h"

namespace contort {

struct Baseline {
  std::set<std::string> buckets;   // ids of buckets
  std::set<Family> families;      // families of these buckets
  std::set<std::string> causes{}; // ids (cause.h) of their causes; empty if the baseline is a list of replays
  std::set<std::string> runs{};   // names of its runs; empty if the baseline is a list
  GroupCounts seen{};               // by its runs; no groups if the baseline is a list
  void add(const std::string& bucket, const std::optional<Family>& family);
  bool contains(const Bucket& bucket) const { return buckets.contains(bucket.id); }
  bool operator==(const Baseline&) const = default;
};

// Reads a baseline from a corpus folder, or from the output of one of two commands. With `contort corpus list
// --json`, fixed buckets do not count as failures of the other branch. With `contort replay FOUND --json`, run by the
// other branch's contort, the failures that still fail there count. Codes baseline.*, corpus.*, file.*, json.*.
Result<Baseline> read_baseline(const std::string& path);

// Returns true if the baseline counts cases and this family shows no more often in `now` than chance explains. A family
// of the kind `broken` must have shown in the baseline, too: a crash is worth a look even if it is rare.
bool may_be_chance(const Family& family, const GroupCounts& now, const Baseline& known);

// Returns true if the bucket gates and the baseline does not contain it. A new bucket also has to show more often than
// chance explains; `now` has no groups where nothing was counted.
bool is_gating(const Bucket& bucket, const std::string& today, const Baseline& known, const GroupCounts& now);

// The families that are known: those in the baseline, and those of buckets that do not gate. A lead that waits to be
// shrunk (leads.h) gates if its family is not among these, because its bucket is not known yet.
std::set<Family> known_families(const std::vector<Bucket>& buckets, const std::string& today, const Baseline& known,
                                const GroupCounts& now);

// Adds another baseline.
void add(const Baseline& more, Baseline& known);

// Sets the news of each cause. Causes that are new or more frequent come first; otherwise the order stays.
void mark_news(std::vector<CauseRow>& rows, const Baseline& known, const GroupCounts& now);

}  // namespace contort
