// Describes one of our generators as a manifest of the protocol. guest_figure.h and guest_offers.h do the reverse.
#pragma once

#include <span>
#include <string>

#include "guest/manifest.h"
#include "model/generator.h"

namespace contort {

// Describes one of our characters with its present parts. Convex hulls and travels are left out.
GuestCharacter describe(const Character& character);

// The named characters with their default parts. Actions whose parameters differ between parts are there once for each
// part. What the protocol cannot express is left out: travels become fixed joints, and parameters that may be missing,
// interrupts, grounds and dynamics do not exist. Codes of build_character.
Result<GuestManifest> describe(Generator& generator, std::span<const std::string> characters);

}  // namespace contort
