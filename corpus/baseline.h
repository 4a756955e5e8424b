// The failures that are known on the branch that a change is compared with: these do not gate.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "corpus/bucket.h"
#include "corpus/leads.h"
#include "model/core/result.h"

namespace contort {

struct Baseline {
  std::set<std::string> buckets;   // ids
  std::set<Family> families;      // of these
  void add(const std::string& bucket, const std::optional<Family>& family);
  bool contains(const Bucket& bucket) const { return buckets.contains(bucket.id); }
  bool operator==(const Baseline&) const = default;
};

// From a corpus' folder, or from what one of two commands printed:
// `contort corpus list --json`: what is fixed there is no failure that the other branch has;
// `contort replay FOUND --json`, by the other branch's contort: what fails there, too, as the case says.
// Codes baseline.*, corpus.*, file.*, json.*.
Result<Baseline> read_baseline(const std::string& path);

// is_gating, of what the baseline does not have.
bool is_gating(const Bucket& bucket, const std::string& today, const Baseline& known);

// Families of which something is known, in the baseline or as buckets that do not gate. Failures that wait to be shrunk
// (leads.h) gate where theirs is none of these: which bucket they belong to, nobody knows yet.
std::set<Family> known_families(const std::vector<Bucket>& buckets, const std::string& today, const Baseline& known);

}  // namespace contort
