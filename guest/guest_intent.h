// The intent that follows from a request and a manifest.
#pragma once

#include <span>

#include "guest/request.h"
#include "model/motion/foreign.h"
#include "model/motion/intent.h"

namespace contort {

// Actions with their frames, and the goals that they promise. There is no queue, because the protocol has none.
Intent intent_of(const GuestManifest& manifest, const std::vector<PlacedUse>& uses, const Character& character);

std::vector<ActionSpan> spans_of(const Intent& intent, int frames);

// The frames in which joints stand still, according to the channels. `joints` are our joints, in the order of the
// manifest.
std::vector<ContactRun> contacts_of(const GuestManifest& manifest, const std::string& character,
                                    std::span<const int> joints, std::span<const ChannelRun> runs);

// The frames into which the whole pose may jump, and the frames into which only the root may jump.
std::vector<int> jumps_of(const std::vector<PlacedUse>& uses);
std::vector<FrameSpan> travels_of(const std::vector<PlacedUse>& uses);

}  // namespace contort
