#include "fuzz/lineage.h"

#include "fuzz/draw.h"
#include "fuzz/mutate.h"

namespace contort {

namespace {

enum Stream : std::uint64_t { kChoice, kChange };

}  // namespace

std::string_view arm_name(Arm arm) {
  constexpr std::string_view kNames[kArms] = {"uniform", "corners", "swarm", "corners_and_swarm", "guided"};
  return kNames[static_cast<std::size_t>(arm)];
}

bool wants_guidance(const Odds& odds, std::int64_t index) {
  return Dice(odds.seed, index, kChoice).below(100) < 100.0 * odds.guided;
}

// A share is even; the rest have corners, or features left out, or both, or neither.
Arm unguided(const Odds& odds, std::int64_t index) {
  Dice dice(odds.seed, index, kChoice);
  dice.next();  // wants_guidance
  if (dice.below(50) < 50.0 * odds.uniform) return Arm::uniform;
  constexpr Arm kMixed[] = {Arm::uniform, Arm::corners, Arm::swarm, Arm::corners_and_swarm};
  return kMixed[dice.below(4)];
}

RawSpec raw_of(const Odds& odds, const Lineage& lineage) {
  const std::int64_t seed = odds.seed;
  RawSpec raw = draw_raw(seed, lineage.front());
  const Arm arm = unguided(odds, lineage.front());
  Dice dice(seed, lineage.front(), kChange);
  if (arm == Arm::corners || arm == Arm::corners_and_swarm) go_to_corners(raw, dice);
  if (arm == Arm::swarm || arm == Arm::corners_and_swarm) leave_out(raw, dice);
  for (std::size_t i = 1; i < lineage.size(); ++i) {
    Dice own(seed, lineage[i], kChange);
    mutate(raw, draw_raw(seed, lineage[i]), own);
  }
  return raw;
}

}  // namespace contort
