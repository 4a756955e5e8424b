// The actions of a generator's manifest as offers for the search.
#pragma once

#include "guest/manifest.h"
#include "model/generator.h"

namespace contort {

// For each part of the character the actions that list its slot; those that list none are the root part's.
Offers offers_of(const GuestManifest& manifest, const Character& character);

// The action as the part of this index offers it.
OfferedAction offer_of(const GuestManifest& manifest, const GuestAction& action, int part = 0);

// Converts a range of seconds to frames.
FrameRange frames_of(const std::array<double, 2>& seconds, double rate_hz);

}  // namespace contort
