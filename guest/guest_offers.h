// The actions of a generator's manifest as offers for the search.
#pragma once

#include "guest/manifest.h"
#include "model/generator.h"

namespace contort {

// Returns the actions for each part of the character. An action is offered on the slots that it lists; without a list,
// on the root part.
Offers offers_of(const GuestManifest& manifest, const Character& character);

// The action as it is offered on the part with this index.
OfferedAction offer_of(const GuestManifest& manifest, const GuestAction& action, int part = 0);

// Converts a range of seconds to frames.
FrameRange frames_of(const std::array<double, 2>& seconds, double rate_hz);

}  // namespace contort
