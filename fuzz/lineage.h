// The origin of cases. A case is its ancestry, the indices of the cases that it was made from, and its own index last.
// In a staged run these are the singles whose actions it combines (stages.h). In other runs the oldest was drawn, and
// every other is a mutation of the one before, with random numbers keyed by its own index. So indices are all that must
// be kept, sent or stored to make any case of a run again.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "fuzz/draw.h"
#include "fuzz/profile.h"
#include "fuzz/raw.h"

namespace contort {

// Ways of making a case. The first three are the stages of a staged run (stages.h). In a run that is not staged, all
// strategies except `uniform` overlay several draws, or mutate such a case; in files the strategy `overlaid` has the
// name "crowded".
enum class Strategy { single, pair, crowd, uniform, overlaid, corners, swarm, corners_and_swarm, guided };
std::string_view strategy_name(Strategy strategy);
inline constexpr int kStrategies = 9;

using Lineage = std::vector<std::int64_t>;  // never empty

// The settings of a run that decide how its cases are made.
struct Odds {
  std::int64_t seed = 1;
  double guided = Profile{}.guided;
  double uniform = Profile{}.uniform;
  bool staged = Profile{}.staged;
};
inline Odds odds_of(std::int64_t seed, const Profile& profile) {
  return {seed, profile.guided, profile.uniform, profile.staged};
}

// Decides how case `index` is made. Early near misses carry no signal, so the share of guided cases rises slowly. If
// there is no near miss to follow yet, the strategy is `unguided` instead.
bool wants_guidance(const Odds& odds, std::int64_t index);
Strategy unguided(const Odds& odds, std::int64_t index);
Strategy strategy_of(const Odds& odds, const Lineage& lineage);

// A mutation that leaves the spec as it was is drawn again, a few times, because most numbers of a case have no effect.
RawSpec raw_of(const DrawConfig& config, Generator& generator, std::int64_t seed, const Lineage& lineage);

}  // namespace contort
