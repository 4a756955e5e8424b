// Decides whether the condition of an interrupt holds in a frame. Frames, clips and sequences are the queue's own
// (timeline/queue.h).
#pragma once

#include <span>

#include "generator/stage.h"

namespace contort {

// `feedback` is the report of the actions, by part; `root` is the place of the figure.
bool condition_holds(const PlannedInterrupt& interrupt, const Stage& stage, std::span<const Feedback> feedback,
              const Rigid& root);

}  // namespace contort
