// The share of a run that this process does.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "model/core/result.h"

namespace contort {

// Shard i of n does the islands i, i + n, i + 2n, … (islands.h).
struct Shard {
  int index = 0;  // from 0
  int count = 1;  // at most kIslands
  bool operator==(const Shard&) const = default;
};

inline bool is_of(const Shard& shard, int island) { return island % shard.count == shard.index; }

// "3/16": shard 3 of 16, from 0. Codes shard.syntax, shard.range.
Result<Shard> parse_shard(const std::string& text);

// The shard that a scheduler names, the first of: GoogleTest (GTEST_SHARD_INDEX, GTEST_TOTAL_SHARDS), Bazel
// (TEST_SHARD_INDEX, TEST_TOTAL_SHARDS), Slurm arrays (SLURM_ARRAY_TASK_ID, _MIN, _STEP, _COUNT), Kubernetes indexed
// jobs (JOB_COMPLETION_INDEX, with CONTORT_SHARDS for the total, which Kubernetes does not tell), GitLab and others
// that count from 1 (CI_NODE_INDEX, CI_NODE_TOTAL). Empty if no variable is set. Codes shard.environment, shard.range.
using Variables = std::function<const char*(const char* name)>;
Result<std::optional<Shard>> shard_of_environment(const Variables& value_of);

}  // namespace contort
