// Where cases come from. A case is its ancestry: the indices of the cases that it was mutated from, oldest first, its own
// index last. The oldest was drawn; every other is a mutation of the one before, thrown with dice keyed by its own
// index. So nothing but indices has to be kept, sent or stored to make any case of a run again.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "fuzz/raw.h"

namespace contort {

// Ways of making a case.
enum class Arm { uniform, corners, swarm, corners_and_swarm, guided };
std::string_view arm_name(Arm arm);
inline constexpr int kArms = 5;

using Lineage = std::vector<std::int64_t>;  // never empty

// How case `index` is made: half of all cases are to be guided. Where there is nothing to be guided by yet, `unguided`
// is the arm instead.
bool wants_guidance(std::int64_t seed, std::int64_t index);
Arm unguided(std::int64_t seed, std::int64_t index);
inline Arm arm_of(std::int64_t seed, const Lineage& lineage) {
  return lineage.size() > 1 ? Arm::guided : unguided(seed, lineage.front());
}

RawSpec raw_of(std::int64_t seed, const Lineage& lineage);

}  // namespace contort
