// residue: the offset of an additive action must be gone when the action is over. It is judged if no other action moved
// the part from the frame before the action to the frame after it: then the part must be where it was. A leg whose foot
// stands also moves with the trunk that it carries, and an arm moves with a walk. A part may also still be on its way
// back from an earlier action.
#include <algorithm>

#include "checks/fixed_limits.h"
#include "checks/joint_steps.h"
#include "checks/plan.h"

namespace contort {

namespace {

constexpr double kRests_rad = 0.01 * kLeft_rad;  // a part that moves less in a frame is at rest, apart from rounding

double difference_rad(const CheckInput& in, const Part& part, int before, int after) {
  double most = 0.0;
  for (const Joint& joint : in.character.joints().subspan(static_cast<std::size_t>(part.first_joint),
                                                          static_cast<std::size_t>(part.joint_count)))
    if (const double d = likeness_rad(joint, in.motion.row(before).data(), in.motion.row(after).data()); !(d <= most)) {
      most = d;
      if (d != d) break;  // NaN is the worst value
    }
  return most;
}

// Merges additive actions that follow each other: from the first one's start to the last one's end.
ActionSpan merged(const CheckInput& in, ActionSpan span) {
  for (bool grows = true; grows;) {
    grows = false;
    for (const ActionSpan& other : in.motion.spans)
      if (other.part == span.part && other.first_frame <= span.last_frame + 1 && other.last_frame > span.last_frame)
        span.last_frame = other.last_frame, grows = true;
  }
  return span;
}

// Returns true if a part hangs on another one, directly or through others.
bool hangs_on(const Character& character, int part, int other) {
  const Part& lower = character.parts()[static_cast<std::size_t>(part)];
  if (lower.joint_count == 0) return false;
  for (int j = lower.first_joint; j >= 0; j = character.joints()[static_cast<std::size_t>(j)].parent)
    if (character.joints()[static_cast<std::size_t>(j)].part == other) return true;
  return false;
}

bool are_one_limb(const Character& character, int part, int other) {
  return part != other && (hangs_on(character, part, other) || hangs_on(character, other, part));
}

// Returns true if an action on an ancestor or a descendant of the part may have moved it between these frames. Additive
// actions count only while one of the frames is in their span. Other actions leave the part where they moved it.
bool moves_with_others(const CheckInput& in, int part, int before, int after) {
  return std::ranges::any_of(in.motion.spans, [&](const ActionSpan& span) {
    if (!are_one_limb(in.character, part, span.part)) return false;
    const IntendedAction* action = action_of(*in.intent, span);
    const auto covers = [&](int frame) { return span.first_frame <= frame && frame <= span.last_frame; };
    if (action == nullptr || action->layer == Layer::additive) return covers(before) || covers(after);
    return span.first_frame <= after && span.last_frame >= before;
  });
}

bool is_at_rest(const CheckInput& in, const Part& part, int frame) {
  return frame == 0 || difference_rad(in, part, frame - 1, frame) <= kRests_rad;
}

}  // namespace

int residue_subject_count(const Character& character) { return static_cast<int>(character.parts().size()); }

Subject residue_subject(const Character& character, int subject) {
  return {character.parts()[static_cast<std::size_t>(subject)].slot, "rad"};
}

void residue_measure(const CheckInput& in, MarginFold& fold) {
  if (in.intent == nullptr || in.motion.response.dof_count > 0) return;
  for (const ActionSpan& first : in.motion.spans) {
    const IntendedAction* action = action_of(*in.intent, first);
    if (action == nullptr || action->layer != Layer::additive) continue;
    const int before = first.first_frame - 1, after = merged(in, first).last_frame + 1;
    if (before < 0 || after >= in.motion.frame_count) continue;
    if (has_layer(in, first.part, Layer::overwrite, before, after) ||
        has_layer(in, first.part, Layer::ik, before, after) ||
        has_layer(in, first.part, Layer::additive, before, before))
      continue;
    const Part& part = in.character.parts()[static_cast<std::size_t>(first.part)];
    if (!is_at_rest(in, part, before) || moves_with_others(in, first.part, before, after)) continue;
    fold.report(first.part, after, kLeft_rad - difference_rad(in, part, before, after));
  }
}

}  // namespace contort
