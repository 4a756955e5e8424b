// What is known already on the branch that a change is compared with: such failures do not gate.
#pragma once

#include <set>
#include <string>

#include "corpus/bucket.h"
#include "generator/core/result.h"

namespace contort {

// Ids of buckets.
using Baseline = std::set<std::string>;

// From a corpus' folder, or a file as `contort corpus list --json` prints it. What is fixed there is not in it: it is
// no failure that the other branch has. Codes baseline.*, corpus.*, file.*, json.*.
Result<Baseline> read_baseline(const std::string& path);

// is_gating, of what the baseline does not have.
bool is_gating(const Bucket& bucket, const std::string& today, const Baseline& known);

}  // namespace contort
