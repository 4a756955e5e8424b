#include "generator/further_actions.h"

#include <algorithm>
#include <cmath>

#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kMisses_rad = 1.0 * kRadPerDeg;  // an aim that is off by less needs no help
constexpr double kFaces_rad = 15.0 * kRadPerDeg;  // a figure that faces its target so nearly does not step round

// The time that a turn is thought to take.
constexpr double kComesIn_s = 0.5;
constexpr double kTurns_rad_s = 35.0 * kRadPerDeg;

// Returns true if a further action moves the part already, for this aim or for another one.
bool is_helped(const Playback& playback, std::span<const LayerStack> stacks, int part) {
  const LayerHold& hold = stacks[at(part)].ik();
  return hold.action >= 0 && planned(playback, hold).further >= 0;
}

// The point of an aim, or of a turn, in the world.
Vec3 target_of(const Stage& stage, const PlannedAction& action) {
  const std::size_t first = action.aim != nullptr ? 1 : 0;
  return stage.start * Vec3(action.params[first], action.params[first + 1], action.params[first + 2]);
}

// The azimuth, off its easiest one, from which on an aim asks for help.
double easy_rad(const PlannedAction& aim) {
  return aim.aim->second.arm >= 0 ? kEasyOfTwoHands_rad : kEasyAim_rad;
}

// Returns true if another aim has a target in another direction, which it would miss if the figure stepped round.
bool aims_elsewhere(const Playback& playback, std::span<const LayerStack> stacks, const Stage& stage,
                    const PlannedAction& aim, const Rigid& root) {
  const double azimuth = azimuth_rad(root, target_of(stage, aim));
  return std::ranges::any_of(stacks, [&](const LayerStack& stack) {
    if (stack.ik().action < 0) return false;
    const PlannedAction& other = planned(playback, stack.ik());
    return other.aim != nullptr && other.further < 0 && other.use != aim.use &&
           std::fabs(wrap_angle(azimuth_rad(root, target_of(stage, other)) - azimuth)) > kEasyAim_rad;
  });
}

}  // namespace

void FurtherActions::begin(const Stage& stage) {
  stage_ = &stage;
  acquired_.assign(stage.timeline.further.size(), Playback::kDormant);
}

// A search, as a spec may have thousands of aims. They stand in the order of their uses.
std::span<const FurtherAction> FurtherActions::of_use(int use) const {
  const std::span<const FurtherAction> all = stage_->timeline.further;
  const auto first = std::ranges::lower_bound(all, use, {}, &FurtherAction::of_use);
  const auto end = std::ranges::upper_bound(all, use, {}, &FurtherAction::of_use);
  return all.subspan(static_cast<std::size_t>(first - all.begin()), static_cast<std::size_t>(end - first));
}

int& FurtherActions::acquired_at(const FurtherAction& further) {
  return acquired_[static_cast<std::size_t>(&further - stage_->timeline.further.data())];
}

bool FurtherActions::faces_elsewhere(const PlannedAction& turn, const Rigid& root) const {
  return std::fabs(azimuth_rad(root, target_of(*stage_, turn))) > kFaces_rad;
}

// One that a twisted arm reaches has the figure turn only where there is the time for it.
bool FurtherActions::needs_help(const Playback& playback, const LayerHold& hold, RuleRunner& rules) const {
  const PlannedAction& aim = planned(playback, hold);
  if (rules.feedback()[at(aim.named)].shortfall > kMisses_rad) return true;
  if (aim.aim->chest < 0) return false;
  const Rigid chest = world_from_socket(*stage_->character, rules.world(), aim.aim->chest);
  const double azimuth = std::fabs(wrap_angle(azimuth_rad(chest, target_of(*stage_, aim)) - aim.aim->second.easy_rad));
  const double left_s = (aim.last_frame - content(playback, hold)) / playback.rate_hz();
  return azimuth > easy_rad(aim) && left_s > kComesIn_s + azimuth / kTurns_rad_s;
}

// The first one that is of use and not acquired yet, unless one before it will do by itself.
bool FurtherActions::acquire(const Playback& playback, const PlannedAction& aim, std::span<const LayerStack> stacks,
                             const RuleRunner& rules, const Rigid& root) {
  for (const FurtherAction& further : of_use(aim.use)) {
    const PlannedAction& help = playback.action(further.action);
    if (is_helped(playback, stacks, help.part)) {
      if (rules.feedback()[at(help.part)].shortfall <= easy_rad(aim)) return false;
    } else if (acquired_at(further) == Playback::kDormant && stacks[at(help.part)].ik().action < 0 &&
               (help.aim != nullptr ||
                (faces_elsewhere(help, root) && !aims_elsewhere(playback, stacks, *stage_, aim, root)))) {
      acquired_at(further) = playback.frame() + 1;
      return true;
    }
  }
  return false;
}

void FurtherActions::ask(const Playback& playback, std::size_t part, std::span<const LayerStack> stacks,
                         RuleRunner& rules, const Rigid& root) {
  const LayerHold& hold = stacks[part].ik();
  if (hold.action < 0 || acquired_.empty()) return;
  const PlannedAction& aim = planned(playback, hold);
  if (aim.aim == nullptr || aim.further >= 0 || aim.named != static_cast<int>(part)) return;
  const bool acquired = needs_help(playback, hold, rules) && acquire(playback, aim, stacks, rules, root);
  rules.body(aim).has_help = acquired || is_coming(playback, hold, stacks, root);
}

bool FurtherActions::is_coming(const Playback& playback, const LayerHold& aim, std::span<const LayerStack> stacks,
                               const Rigid& root) const {
  const PlannedAction& action = planned(playback, aim);
  if (content(playback, aim) + 1 > action.end - action.blend_out) return false;
  for (const FurtherAction& further : of_use(action.use)) {
    const PlannedAction& help = playback.action(further.action);
    if (!is_helped(playback, stacks, help.part)) continue;
    const bool is_in = come_in(playback, stacks[at(help.part)].ik()) >= 1.0;
    if (!is_in || (help.aim == nullptr && faces_elsewhere(help, root))) return true;
  }
  return false;
}

}  // namespace contort
