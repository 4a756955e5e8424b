// The strength with which an additive action moves its part.
#pragma once

#include <optional>

#include "generator/playback.h"

namespace contort {

// Frames for which an additive runs on after its run was cut; at least one.
int cut_fade_frames(double rate_hz);

// The weight of an additive in the playback's frame of a run, in [0, 1]; nothing where it does not move its part. One
// that is cut would be gone from one frame to the next: it runs on while it fades out, and fades in again where it goes
// on.
std::optional<double> additive_weight(const Playback& playback, const PlannedAction& action, const QueueSpan& run);

}  // namespace contort
