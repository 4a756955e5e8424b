#include "checks/plan.h"

#include <algorithm>

namespace contort {

const PlannedAction* planned_of(const Timeline& timeline, const ActionSpan& span) {
  const auto found = std::ranges::find_if(timeline.actions, [&](const PlannedAction& a) {
    return a.sequence == span.sequence && a.clip == span.clip && a.action == span.action && a.part == span.part;
  });
  return found == timeline.actions.end() ? nullptr : &*found;
}

int content_frame(const Motion& motion, int sequence, int frame) {
  for (const QueueSpan& run : motion.queue)
    if (run.sequence == sequence && run.first_frame <= frame && frame <= run.last_frame)
      return run.first_content + frame - run.first_frame;
  return -1;
}

bool has_layer(const CheckInput& in, int part, Layer layer, int first, int last) {
  return std::ranges::any_of(in.motion.spans, [&](const ActionSpan& span) {
    if (span.part != part || span.first_frame > last || span.last_frame < first) return false;
    const PlannedAction* action = planned_of(*in.timeline, span);
    return action != nullptr && action->def->layer == layer;
  });
}

}  // namespace contort
