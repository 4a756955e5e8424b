// The search's memory. The cases of a run are spread over 64 islands that never hear of each other, so a run gives the
// same cases for any number of threads and machines. An island is guided by the subjects that its number falls to: it
// keeps the cases that came nearest to each one's limit, and mutates them until the limit is broken.
//
// Margins are compared in their check's scale and pools are chosen evenly: one sum over all checks would let the unit of
// one mask the others (Zhang, Hasuo and Arcaini, CAV 2019).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fuzz/lineage.h"

namespace contort {

inline constexpr int kIslands = 64;
inline constexpr int kGeneration = 4;                  // cases of one island between two looks at its pools
inline constexpr int kRound = kIslands * kGeneration;  // cases of a run between two looks

inline int island_of(std::int64_t index) { return static_cast<int>(index / kGeneration % kIslands); }

// Subjects are families: "joint_range|human|arm_left/elbow max".
int island_of_target(const std::string& family);

// How near a case came.
struct NearMiss {
  std::string family;
  double margin = 0.0;  // in the check's scale; >= 0
  bool operator==(const NearMiss&) const = default;
};

struct PoolEntry {
  double margin = 0.0;
  Lineage lineage;
  bool operator==(const PoolEntry&) const = default;
};

class Island {
 public:
  // The ancestry of case `index`: a mutation of one of the pool where there is any and the case wants it.
  Lineage lineage_of(const Odds& odds, std::int64_t index) const;

  // What a case showed, in the order of cases.
  void learn(const Lineage& lineage, const std::vector<NearMiss>& near, const std::vector<std::string>& broken);

  bool operator==(const Island&) const = default;

  // Open for whoever stores them.
  std::map<std::string, std::vector<PoolEntry>> pools;  // by family; nearest first
  std::vector<std::string> retired;                     // broken, sorted: nothing is left to be found near them
};

}  // namespace contort
