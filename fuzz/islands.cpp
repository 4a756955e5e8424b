#include "fuzz/islands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/hash.h"

namespace contort {

namespace {

constexpr std::size_t kPool = 3;          // greatest number of cases of one subject
constexpr std::size_t kLongestLine = 24;  // greatest number of ancestors; making a case again takes as many mutations
constexpr int kTournament = 4;            // number of subjects from which the most promising one is chosen
constexpr std::uint64_t kParentStream = 0x706172656e74ULL;

bool insert_sorted(std::vector<Family>& list, const Family& family) {
  const auto at = std::ranges::lower_bound(list, family);
  if (at != list.end() && *at == family) return false;
  list.insert(at, family);
  return true;
}

void keep_nearest(std::vector<PoolEntry>& nearest, const PoolEntry& entry) {
  const auto at = std::ranges::lower_bound(nearest, entry.margin, {}, &PoolEntry::margin);
  if (at != nearest.end() && at->margin == entry.margin) return;
  nearest.insert(at, entry);
  if (nearest.size() > kPool) nearest.pop_back();
}

}  // namespace

int group_of_target(const Family& family) {
  Hash64 hash;
  hash.add(std::string_view(print_family(family)));
  return static_cast<int>((hash.value() >> 16) % kTargetGroups);
}

double TargetPool::relative_distance() const {
  if (nearest.empty() || farthest <= nearest.front().margin) return std::numeric_limits<double>::infinity();
  return nearest.front().margin / (farthest - nearest.front().margin);
}

// The best of a few that are drawn uniformly: all have a chance, promising ones a greater one.
const TargetPool* Island::promising(Dice& dice) const {
  std::vector<const TargetPool*> open;
  for (const auto& [family, pool] : pools)
    if (std::isfinite(pool.relative_distance())) open.push_back(&pool);
  if (open.empty()) return nullptr;
  const TargetPool* best = open[static_cast<std::size_t>(dice.below(static_cast<int>(open.size())))];
  for (int i = 1; i < kTournament; ++i) {
    const TargetPool* other = open[static_cast<std::size_t>(dice.below(static_cast<int>(open.size())))];
    if (other->relative_distance() < best->relative_distance()) best = other;
  }
  return best;
}

Lineage Island::lineage_of(const Odds& odds, std::int64_t index) const {
  if (!wants_guidance(odds, index)) return {index};
  Dice dice(odds.seed, index, kParentStream);
  const TargetPool* pool = promising(dice);
  if (pool == nullptr) return {index};
  Lineage lineage = pool->nearest[static_cast<std::size_t>(dice.below(static_cast<int>(pool->nearest.size())))].lineage;
  lineage.push_back(index);
  return lineage;
}

void Island::learn(const Lineage& lineage, const std::vector<NearMiss>& near, const std::vector<Family>& broken) {
  for (const Family& family : broken)
    if (group_of_target(family) == group_of(lineage.back()) && insert_sorted(retired, family)) pools.erase(family);
  for (const NearMiss& miss : near) {
    if (std::ranges::binary_search(retired, miss.family)) continue;
    TargetPool& pool = pools[miss.family];
    pool.farthest = std::max(pool.farthest, miss.margin);
    if (lineage.size() < kLongestLine) keep_nearest(pool.nearest, {miss.margin, lineage});
  }
}

}  // namespace contort
