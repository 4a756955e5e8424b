#include "corpus/group_counts.h"

#include <algorithm>

namespace contort {

namespace {

constexpr double kLeastChance = 0.001;

// The probability of exactly `now` of `now + before` sightings. The factors are taken in an order that keeps the
// product near 1, so that it does not leave the range of a double while factors are left.
double chance_of_exactly(std::int64_t now, std::int64_t before, double share) {
  double chance = 1.0;
  std::int64_t ways = 0, hits = 0, misses = 0;
  while (ways < before || hits < now || misses < before) {
    if (ways < before && (chance <= 1.0 || (hits == now && misses == before)))
      ++ways, chance *= static_cast<double>(now + ways) / static_cast<double>(ways);
    else if (hits < now)
      ++hits, chance *= share;
    else
      ++misses, chance *= 1.0 - share;
  }
  return chance;
}

}  // namespace

GroupCounts group_counts_of(std::span<const RunRecord> runs, const std::set<std::string>& except) {
  GroupCounts sum;
  for (const RunRecord& run : runs) {
    if (except.contains(run.name)) continue;
    sum.groups += run.groups;
    for (const auto& [family, count] : run.families)
      if (count.groups > 0) sum.of_family[family] += count.groups;
  }
  return sum;
}

void add(const GroupCounts& more, GroupCounts& sum) {
  sum.groups += more.groups;
  for (const auto& [family, groups] : more.of_family) sum.of_family[family] += groups;
}

std::int64_t groups_with(const Family& family, const GroupCounts& seen) {
  const auto at = seen.of_family.find(family);
  return at == seen.of_family.end() ? 0 : at->second;
}

// Each term of the binomial sum follows from the one before.
double chance_of_as_many(std::int64_t now, std::int64_t before, double share) {
  double term = chance_of_exactly(now, before, share), sum = term;
  for (; before > 0 && term > 0.0; --before) {
    term *= static_cast<double>(before) / static_cast<double>(++now) * share / (1.0 - share);
    sum += term;
  }
  return std::min(sum, 1.0);
}

bool is_more_frequent(const Family& family, const GroupCounts& now, const GroupCounts& before) {
  const std::int64_t seen_now = groups_with(family, now), seen_before = groups_with(family, before);
  if (now.groups == 0 || before.groups == 0 || seen_now == 0) return false;
  const double share = static_cast<double>(now.groups) / static_cast<double>(now.groups + before.groups);
  if (static_cast<double>(seen_now) <= share * static_cast<double>(seen_now + seen_before)) return false;
  return chance_of_as_many(seen_now, seen_before, share) < kLeastChance;
}

}  // namespace contort
