// Counts how often runs saw each family, and tests whether one run saw it more often than chance explains.
//
// GroupCounts are counted in groups of cases. The cases of a group share a setting (fuzz/stages.h), so that one bad
// setting shows a family in many of them; groups are independent of each other.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>

#include "corpus/runs.h"

namespace contort {

struct GroupCounts {
  std::int64_t groups = 0;  // of all runs; 0: unknown
  std::map<Family, std::int64_t> of_family{};  // groups in which at least one case showed it
  bool operator==(const GroupCounts&) const = default;
};

// Adds up the groups of runs, except the runs with these names.
GroupCounts group_counts_of(std::span<const RunRecord> runs, const std::set<std::string>& except = {});
void add(const GroupCounts& more, GroupCounts& sum);

// The number of groups of `seen` that showed the family.
std::int64_t groups_with(const Family& family, const GroupCounts& seen);

// Returns true if the family shows in so many more groups of `now` that chance alone would do this less than once in
// a thousand times, although it is as frequent as before. This is the exact test for two rates of rare events: of all
// sightings, those of `now` are binomial with the share of its groups (J. Przyborowski and H. Wilenski, "Homogeneity of
// results in testing samples from Poisson series", Biometrika 31, 1940). False if either side has no groups.
bool is_more_frequent(const Family& family, const GroupCounts& now, const GroupCounts& before);

// The chance, [0, 1], of at least `now` of `now + before` sightings, each of which is one of `now` with the
// probability `share`, in (0, 1).
double chance_of_as_many(std::int64_t now, std::int64_t before, double share);

}  // namespace contort
