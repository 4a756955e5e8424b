// Whether what an interrupt waits for holds in a frame. Frames, clips and sequences are the queue's own
// (timeline/queue.h).
#pragma once

#include <span>

#include "generator/stage.h"

namespace contort {

// `feedback` is what the actions told, by part; `root` is where the figure is.
bool condition_holds(const PlannedInterrupt& interrupt, const Stage& stage, std::span<const Feedback> feedback,
              const Rigid& root);

}  // namespace contort
