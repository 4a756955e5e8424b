#include "checks/plan.h"

#include <algorithm>

namespace contort {

const IntendedAction* action_of(const Intent& intent, const ActionSpan& span) {
  const auto found =
      std::ranges::find_if(intent.actions, [&](const IntendedAction& action) { return is_of(span, action); });
  return found == intent.actions.end() ? nullptr : &*found;
}

bool has_layer(const CheckInput& in, int part, Layer layer, int first, int last) {
  return std::ranges::any_of(in.motion.spans, [&](const ActionSpan& span) {
    if (span.part != part || span.first_frame > last || span.last_frame < first) return false;
    const IntendedAction* action = action_of(*in.intent, span);
    return action != nullptr && action->layer == layer;
  });
}

}  // namespace contort
