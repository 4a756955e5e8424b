#include "guest/guest_intent.h"

#include <algorithm>

#include "guest/basis.h"
#include "guest/guest_figure.h"
#include "guest/manifest_check.h"
#include "model/core/index.h"

namespace contort {

namespace {

IntendedAction intended(const PlacedUse& placed, const Character& character) {
  IntendedAction action;
  action.sequence = placed.sequence, action.clip = placed.clip, action.action = placed.index;
  action.part = action.named = character.find_part(placed.use->slot);
  action.name = placed.use->action;
  action.layer = placed.action->layer;
  action.start = placed.start_frame, action.end = placed.end_frame();
  action.blend_in = std::max(0, placed.use->blend_in_frames), action.blend_out = placed.use->blend_out_frames;
  action.first_frame = placed.start_frame, action.last_frame = placed.end_frame();
  return action;
}

// The goal that the tip is at the point in the last frame of the action.
Goal goal_of(const GuestManifest& manifest, const PlacedUse& placed, const Character& character) {
  const Basis basis(manifest.convention);
  const GuestCharacter& from = *find_character(manifest, character.name());
  const GuestGoal& promised = *placed.action->goal;
  const int joint = find_joint(from, promised.tip);
  Goal goal;
  goal.first_frame = goal.last_frame = placed.end_frame();
  goal.part = character.find_part(placed.use->slot);
  goal.socket = joint < 0 ? -1 : character.find_socket(slots_of(from)[at(joint)] + "/" + joint_names(from)[at(joint)]);
  const auto given = placed.use->params.find(promised.param);
  const auto def = std::ranges::find(placed.offer->params, promised.param, &ParamDef::name);
  goal.target_m = basis.point_m(std::get<Vec3>(given == placed.use->params.end() ? def->preset : given->second));
  goal.in_world = true;
  goal.within_m = promised.within * basis.unit_m();
  return goal;
}

}  // namespace

namespace {

// True if another use of the slot takes over before this goal's end; the goal is then not promised any more.
bool is_taken_over(const PlacedUse& placed, const std::vector<PlacedUse>& uses) {
  return std::ranges::any_of(uses, [&](const PlacedUse& other) {
    return &other != &placed && other.use->slot == placed.use->slot && other.start_frame >= placed.start_frame &&
           other.start_frame <= placed.end_frame();
  });
}

}  // namespace

Intent intent_of(const GuestManifest& manifest, const std::vector<PlacedUse>& uses, const Character& character) {
  Intent intent;
  for (const PlacedUse& placed : uses) {
    intent.actions.push_back(intended(placed, character));
    if (!placed.action->goal || is_taken_over(placed, uses)) continue;
    if (const Goal goal = goal_of(manifest, placed, character); goal.socket >= 0) intent.goals.push_back(goal);
  }
  return intent;
}

std::vector<ActionSpan> spans_of(const Intent& intent, int frames) {
  std::vector<ActionSpan> spans;
  for (const IntendedAction& action : intent.actions)
    if (action.first_frame < frames)
      spans.push_back({action.first_frame, std::min(action.last_frame, frames - 1), action.sequence, action.clip,
                       action.action, action.part});
  return spans;
}

std::vector<ContactRun> contacts_of(const GuestManifest& manifest, const std::string& character,
                                    std::span<const int> joints, std::span<const ChannelRun> runs) {
  std::vector<ContactRun> contacts;
  for (const ChannelRun& run : runs) {
    const auto channel = std::ranges::find(manifest.channels, run.channel, &GuestChannel::name);
    if (channel->contact.empty()) continue;
    const int joint = find_joint(*find_character(manifest, character), channel->contact);
    if (joint >= 0) contacts.push_back({joints[at(joint)], run.first_frame, run.last_frame});
  }
  return contacts;
}

std::vector<int> jumps_of(const std::vector<PlacedUse>& uses) {
  std::vector<int> jumps;
  for (const PlacedUse& placed : uses) {
    const Effect effect = placed.action->effect;
    if (effect == Effect::cut || effect == Effect::rest || effect == Effect::equals) jumps.push_back(placed.start_frame);
    if (effect == Effect::cut) jumps.push_back(placed.end_frame());
  }
  std::ranges::sort(jumps);
  return jumps;
}

std::vector<FrameSpan> travels_of(const std::vector<PlacedUse>& uses) {
  std::vector<FrameSpan> travels;
  for (const PlacedUse& placed : uses)
    if (placed.action->travels)
      travels.push_back({placed.start_frame, placed.end_frame() + placed.use->blend_out_frames});
  return travels;
}

}  // namespace contort
