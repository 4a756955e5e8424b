// Describes one of our generators as a manifest of the protocol. guest_figure.h and guest_offers.h do the reverse.
#pragma once

#include <span>
#include <string>

#include "guest/manifest.h"
#include "model/generator.h"

namespace contort {

// Describes one of our characters with its present parts. Convex hulls and travels are left out.
GuestCharacter describe(const Character& character);

// Describes the named characters with their default parts. An action whose parameters differ between parts is listed
// once for each part. The result has only items that the protocol can express: travels become fixed joints, and
// optional parameters, interrupts, grounds and dynamics are left out. Codes of build_character.
Result<GuestManifest> describe(Generator& generator, std::span<const std::string> characters);

}  // namespace contort
