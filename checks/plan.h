// What was to be played, as checks ask for it: which of the spec's actions had a part in a frame, and how far it had
// come.
#pragma once

#include "checks/check.h"
#include "generator/stage.h"

namespace contort {

// The planned action of a span; nullptr where the timeline has none.
const PlannedAction* planned_of(const Timeline& timeline, const ActionSpan& span);

// Frame of its own sequence in which a span's action stands in this frame of the motion; -1 where it does not run.
int content_frame(const Motion& motion, int sequence, int frame);

// Whether a span of this layer covers the part in any of the frames [first, last].
bool has_layer(const CheckInput& in, int part, Layer layer, int first, int last);

}  // namespace contort
