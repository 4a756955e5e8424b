#include "generator/limb_keeper.h"

#include <algorithm>

namespace contort {

// Poses are taken as their authors give them, and walking legs as their gait has them.
bool LimbKeeper::makes_way(const Playback& playback, std::size_t p) const {
  const LayerHold& ik = s_.stacks[p].ik();
  if (ik.action >= 0) return !moves_legs(playback, ik) && !is_cut(playback, ik);
  return s_.added[p] != 0 || (s_.behind[p] != 0 && s_.stacks[p].overwrite().action < 0);
}

int LimbKeeper::held_socket(const Playback& playback, std::size_t p) const {
  const LayerHold& ik = s_.stacks[p].ik();
  const bool holds = ik.action >= 0 && planned(playback, ik).def->promise == Promise::holds;
  return holds ? static_cast<int>(planned(playback, ik).params[0]) : -1;
}

bool LimbKeeper::acts(const Playback& playback, const Limb& limb) const {
  return std::ranges::any_of(limb.parts, [&](int p) { return makes_way(playback, at(p)); });
}

// As of now for limbs that are finished, else with the shift of the frame before.
LegUse LimbKeeper::use_of(const Playback& playback, const Limb& limb) const {
  if (acts(playback, limb)) return LegUse::acts;
  const bool is_placed = std::ranges::any_of(limb.parts, [&](int p) {
    return s_.stacks[at(p)].overwrite().action >= 0 || s_.stacks[at(p)].ik().action >= 0;
  });
  if (is_placed) return LegUse::placed;
  const Shift shift = s_.shift[at(limb.parts.back())];
  return shift == Shift::lifted || shift == Shift::held_off ? LegUse::acts : LegUse::idle;
}

// All parts of the limb are placed.
void LimbKeeper::finish(const Playback& playback, const Limb& limb) {
  const LegUse use = use_of(playback, limb);
  shift(limb, Shift::none);
  s_.rules.room().hold(at(limb.parts.back()), held_socket(playback, at(limb.parts.front())));
  if (use == LegUse::acts) keep_clear(limb);
  if (use == LegUse::idle) plant(limb);
}

void LimbKeeper::shift(const Limb& limb, Shift shift) {
  for (const int p : limb.parts) s_.shift[at(p)] = shift;
  s_.shift_count += shift != Shift::none;
}

void LimbKeeper::plant(const Limb& limb) {
  const StandingFeet& feet = s_.rules.feet();
  for (const int leg : limb.legs)
    if (limb.is_its_own(stage_.legs[at(leg)]) && feet.is_planted(at(leg)) &&
        feet.plant(at(leg), s_.rules.world(), s_.postures.shown.coords))
      shift(limb, Shift::planted);
}

void LimbKeeper::note_feet(const Playback& playback) {
  for (std::size_t leg = 0; leg < stage_.legs.size(); ++leg)
    s_.rules.feet().note(leg, use_of(playback, limb_at(at(stage_.legs[leg].part))), s_.rules.world());
}

void LimbKeeper::keep_clear(const Limb& limb) {
  switch (s_.clearance.keep(at(limb.parts.back()), s_.past, s_.postures.shown, s_.rules.world())) {
    case Clearance::Kept::as_wanted: return;
    case Clearance::Kept::foot_lifted: return shift(limb, Shift::lifted);
    case Clearance::Kept::elsewhere: break;
  }
  shift(limb, Shift::held_off);
  for (const int p : limb.parts) s_.path.correct(at(p), s_.postures.shown.coords);
}


}  // namespace contort
