// Requests that a manifest's relations make from a spec: `gain` and `mirror` (docs/reference/guests.md).
#pragma once

#include <optional>
#include <span>

#include "guest/frames.h"
#include "guest/manifest.h"
#include "guest/request.h"
#include "model/spec/spec.h"

namespace contort {

// The spec with each number and each component of a vec3 moved by this share of its range, towards the end that is
// farther away. Parameters that the spec leaves out are moved from their default.
Spec nudged(const Spec& spec, std::span<const PlacedUse> uses);
inline constexpr double kNudge = 1e-4;

// For each joint of the character the joint of the other side: itself for those in the middle.
std::vector<std::size_t> partners_of(const GuestCharacter& character);

// The slot of the other side.
std::string other_slot(const GuestCharacter& character, const std::string& slot);

// The spec for the other side of the figure. Nothing where the manifest does not offer it: the action or the part does
// not exist there, or a value is out of its range.
std::optional<Spec> mirrored(const GuestManifest& manifest, const Spec& spec, std::span<const PlacedUse> uses,
                             const Character& character, const Offers& offers);

// The mirror image of a motion, about the plane x = 0 of our world. Each joint's rotation against its rest pose, in
// axes of the world, becomes that of its partner with y and z reversed.
Motion mirror_image(const GuestCharacter& from, const Rigid& root_at_rest, const FrameLayout& layout,
                    const Motion& motion);

}  // namespace contort
