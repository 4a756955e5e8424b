// The part of LimbKeeper that keeps legs where they stand.
#include <algorithm>
#include <array>

#include "generator/limb_keeper.h"
#include "generator/motion/blend.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

bool LimbKeeper::is_as_rested(const Leg& leg) const {
  return std::ranges::all_of(std::array{leg.part, leg.foot_part}, [&](int p) {
    const Part& part = stage_.character->parts()[at(p)];
    const auto base = s_.postures.base.coords.begin() + part.first_coord;
    return std::equal(base, base + part.coord_count, s_.rested.coords.begin() + part.first_coord);
  });
}

void LimbKeeper::rest(std::size_t p) {
  const Character& character = *stage_.character;
  const StandingFeet& feet = s_.rules.feet();
  for (std::size_t i = 0; i < stage_.legs.size(); ++i) {
    const Leg& leg = stage_.legs[i];
    if (at(leg.part) != p || carrier_of(character, leg.part) == 0) continue;
    const bool rests = feet.rests_at(i) && is_as_rested(leg);
    for (const int part : {leg.part, leg.foot_part}) {
      s_.rests[at(part)] = rests;
      if (rests) copy_part(character, at(part), s_.postures.base, s_.postures.stand);
    }
    if (!rests) continue;
    place(leg, s_.postures.stand);
    feet.put_to_rest(i, s_.rules.world(), s_.postures.stand.coords);
  }
}

bool LimbKeeper::stays_planted(std::size_t p) const {
  const LayerStack& stack = s_.stacks[p];
  if (s_.rests[p] == 0 || s_.added[p] != 0 || stack.overwrite().action >= 0 || stack.ik().action >= 0) return false;
  const std::span<const int> legs = limb_at(p).legs;
  return std::ranges::all_of(legs, [&](int i) { return s_.rules.feet().is_planted(at(i)); });
}

bool LimbKeeper::stops_with_hips(std::size_t p) const {
  const LayerStack& stack = s_.stacks[p];
  if (s_.added[p] != 0 || stack.overwrite().action >= 0 || stack.ik().action >= 0) return false;
  const Part& part = stage_.character->parts()[p];
  const auto coords = s_.postures.shown.coords.begin() + part.first_coord;
  if (!std::equal(coords, coords + part.coord_count, s_.past.before.coords.begin() + part.first_coord)) return false;
  for (std::size_t i = 0; i < stage_.legs.size(); ++i) {
    const Leg& leg = stage_.legs[i];
    const bool is_of_it = at(leg.part) == p || at(leg.foot_part) == p;
    if (is_of_it && carrier_of(*stage_.character, leg.part) == 0)
      return !s_.rules.feet().moves(i) && s_.rules.feet().rests_at(i);
  }
  return false;
}

void LimbKeeper::plant(const Limb& limb) {
  const StandingFeet& feet = s_.rules.feet();
  for (const int leg : limb.legs) {
    if (!limb.is_its_own(stage_.legs[at(leg)])) continue;
    if (feet.is_planted(at(leg)) ? feet.plant(at(leg), s_.rules.world(), s_.postures.shown.coords)
                                 : stay_after_course(leg))
      shift(limb, Shift::planted);
  }
}

// In the first frame after a course of legs, the trunk that carries a leg may go on, or be hit: the foot stays where
// the course has put it.
bool LimbKeeper::stays_after_course(int leg) const {
  const StandingFeet& feet = s_.rules.feet();
  const bool is_carried = carrier_of(*stage_.character, stage_.legs[at(leg)].part) != 0;
  return is_carried && !feet.moves(at(leg)) && feet.rests_at(at(leg)).has_value();
}

bool LimbKeeper::stay_after_course(int leg) {
  if (!stays_after_course(leg)) return false;
  s_.rules.feet().put_to_rest(at(leg), s_.rules.world(), s_.postures.shown.coords);
  return true;
}

}  // namespace contort
