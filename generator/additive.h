// The strength with which an additive action moves its part.
#pragma once

#include <optional>

#include "generator/playback.h"

namespace contort {

// The number of frames for which an additive continues after its run was cut; at least one.
int cut_fade_frames(double rate_hz);

// The weight of an additive in the playback's frame of a run, in [0, 1]; nothing if it does not move its part. A cut
// additive would vanish from one frame to the next, so it continues while it fades out, and fades in again when its
// sequence continues.
std::optional<double> additive_weight(const Playback& playback, const PlannedAction& action, const QueueSpan& run);

}  // namespace contort
