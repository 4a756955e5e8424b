#include "fuzz/islands.h"

#include <algorithm>

#include "fuzz/dice.h"
#include "generator/core/hash.h"

namespace contort {

namespace {

constexpr std::size_t kPool = 3;         // cases of one subject
constexpr std::size_t kLongestLine = 24;  // ancestors: making a case again takes as many mutations
constexpr std::uint64_t kParentStream = 0x706172656e74ULL;

}  // namespace

int island_of_target(const std::string& family) {
  Hash64 hash;
  hash.add(std::string_view(family));
  return static_cast<int>((hash.value() >> 16) % kIslands);
}

Lineage Island::lineage_of(const Odds& odds, std::int64_t index) const {
  if (pools.empty() || !wants_guidance(odds, index)) return {index};
  Dice dice(odds.seed, index, kParentStream);
  const std::vector<PoolEntry>& pool = std::next(pools.begin(), dice.below(static_cast<int>(pools.size())))->second;
  Lineage lineage = pool[static_cast<std::size_t>(dice.below(static_cast<int>(pool.size())))].lineage;
  lineage.push_back(index);
  return lineage;
}

void Island::learn(const Lineage& lineage, const std::vector<NearMiss>& near, const std::vector<std::string>& broken) {
  for (const std::string& family : broken) {
    if (island_of_target(family) != island_of(lineage.back())) continue;
    if (const auto at = std::ranges::lower_bound(retired, family); at == retired.end() || *at != family) {
      retired.insert(at, family);
      pools.erase(family);
    }
  }
  if (lineage.size() >= kLongestLine) return;
  for (const NearMiss& miss : near) {
    if (std::ranges::binary_search(retired, miss.family)) continue;
    std::vector<PoolEntry>& pool = pools[miss.family];
    const auto at = std::ranges::upper_bound(pool, miss.margin, {}, &PoolEntry::margin);
    if (at == pool.end() && pool.size() >= kPool) continue;
    pool.insert(at, {miss.margin, lineage});
    if (pool.size() > kPool) pool.pop_back();
  }
}

}  // namespace contort
