#include "generator/promise_watch.h"

#include <algorithm>

namespace contort {

namespace {

constexpr double kMet = 5e-4;  // m, rad: a request that is missed by less is met

}  // namespace

void PromiseWatch::note(const Playback& playback, std::size_t part) {
  note_lag(playback, part);
  record_aim(playback, part);
}

bool PromiseWatch::falls_short(std::size_t p) const { return s_.rules.feedback()[p].shortfall > kMet; }

bool PromiseWatch::is_coming(const Playback& playback, const LayerHold& ik) const {
  return come_in(playback, ik) < 1.0 || left_of(playback, ik) < 1.0 ||
         s_.further.is_coming(playback, ik, s_.stacks, s_.postures.shown.root);
}

std::optional<Shortfall> PromiseWatch::shortfall_of(const Playback& playback, std::size_t p) const {
  const Feedback& told = s_.rules.feedback()[p];
  const LayerHold& ik = s_.stacks[p].ik();
  const bool has_ik = ik.action >= 0;
  if (told.failed) return Shortfall::rule_failed;
  if (s_.shift[p] == Shift::held_off || s_.shift[p] == Shift::lifted) return Shortfall::clearance;
  if (s_.shift[p] == Shift::over_feet) return Shortfall::out_of_reach;
  if (s_.behind[p] != 0 || (has_ik && told.is_slower)) return Shortfall::joint_speed;
  if (has_ik && told.at_range_end) return Shortfall::joint_range;
  if (!falls_short(p)) return std::nullopt;
  // An aim that ends while help is on its way would have needed more time.
  const bool has_help = has_ik && s_.rules.body(planned(playback, ik)).has_help;
  return has_help ? Shortfall::joint_speed : Shortfall::out_of_reach;
}

void PromiseWatch::note_lag(const Playback& playback, std::size_t p) {
  const LayerHold& ik = s_.stacks[p].ik();
  if (ik.action >= 0 && is_coming(playback, ik)) return s_.lags.note(playback.frame(), p, std::nullopt);
  if (const auto why = shortfall_of(playback, p)) s_.lags.note(playback.frame(), p, why);
}

// Returns true if nothing but this aim moves the part, and the part is where the aim wants it.
bool PromiseWatch::is_alone(const Playback& playback, const PlannedAction& aim, std::size_t p) const {
  const LayerHold& ik = s_.stacks[p].ik();
  return ik.action >= 0 && planned(playback, ik).use == aim.use && come_in(playback, ik) >= 1.0 && s_.added[p] == 0 &&
         s_.behind[p] == 0 && s_.shift[p] == Shift::none;
}

// Returns true if an aim is fully in force.
bool PromiseWatch::is_full(const Playback& playback, const LayerHold& hold) const {
  const PlannedAction& action = planned(playback, hold);
  return come_in(playback, hold) >= 1.0 && left_of(playback, hold) >= 1.0 && playback.frame() > hold.frame &&
         std::ranges::all_of(action.aim->chain.joints, [&](int joint) {
           return is_alone(playback, action, at(stage_.character->joints()[at(joint)].part));
         });
}

void PromiseWatch::record_aim(const Playback& playback, std::size_t p) {
  const LayerHold& hold = s_.stacks[p].ik();
  if (hold.action < 0) return;
  const PlannedAction& action = planned(playback, hold);
  if (action.aim == nullptr || action.named != static_cast<int>(p) || !is_full(playback, hold) || falls_short(p)) return;
  const Vec3 target(action.params[1], action.params[2], action.params[3]);
  s_.spans.aim(playback.frame(), hold.action, stage_.start * target);
}


}  // namespace contort
