// Decides whether the condition of an interrupt holds in a frame. The queue itself handles frames, clips and sequences
// (timeline/queue.h).
#pragma once

#include <span>

#include "generator/stage.h"

namespace contort {

// `feedback` is the report of the actions, by part; `root` is the place of the figure.
bool condition_holds(const PlannedInterrupt& interrupt, const Stage& stage, std::span<const Feedback> feedback,
              const Rigid& root);

}  // namespace contort
