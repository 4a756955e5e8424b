// The search's memory. The cases of a run are spread over 64 islands that exchange nothing, so a run gives the same
// cases for any number of threads and machines. Every subject of a check belongs to one of eight groups, and the
// subjects of one group guide each island: it keeps the cases that came nearest to each one's limit, and mutates them
// until the limit is broken.
//
// Margins are compared in their check's scale, and one subject is chosen at a time: one sum over all checks would let
// the unit of one mask the others (Zhang, Hasuo and Arcaini, CAV 2019).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "checks/family.h"
#include "fuzz/dice.h"
#include "fuzz/lineage.h"

namespace contort {

inline constexpr int kIslands = 64;
inline constexpr int kGeneration = 4;                  // cases of one island between two updates of its pools
inline constexpr int kRound = kIslands * kGeneration;  // cases of a run between two updates of the pools

inline constexpr int kTargetGroups = 8;

inline int island_of(std::int64_t index) { return static_cast<int>(index / kGeneration % kIslands); }
inline int group_of(std::int64_t index) { return island_of(index) % kTargetGroups; }

int group_of_target(const Family& family);

// The distance by which a case missed the limit of this family, without breaking it.
struct NearMiss {
  Family family;
  double margin = 0.0;  // in the check's scale; >= 0
  bool operator==(const NearMiss&) const = default;
};

struct PoolEntry {
  double margin = 0.0;
  Lineage lineage;
  bool operator==(const PoolEntry&) const = default;
};

// An island's knowledge of one subject.
struct TargetPool {
  std::vector<PoolEntry> nearest;  // nearest first; equal margins are skipped, because then the mutation had no effect
  double farthest = 0.0;           // the greatest margin seen
  bool operator==(const TargetPool&) const = default;

  // The distance to the limit divided by the variation of the margin so far; infinite if the margin never varied. A
  // small value is promising.
  double relative_distance() const;
};

class Island {
 public:
  // Returns the ancestry of case `index`. If the case is to be guided and there is a promising pool, it is a mutation
  // of a case of that pool.
  Lineage lineage_of(const Odds& odds, std::int64_t index) const;

  // Records the results of a case. Must be called in the order of cases.
  void learn(const Lineage& lineage, const std::vector<NearMiss>& near, const std::vector<Family>& broken);

  bool operator==(const Island&) const = default;

  // Public, so that they can be stored.
  std::map<Family, TargetPool> pools;
  std::vector<Family> retired;         // broken families, sorted; the search no longer follows them

 private:
  const TargetPool* promising(Dice& dice) const;
};

}  // namespace contort
