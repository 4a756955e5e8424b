// Requests that a manifest's relations make from a spec: `gain` and `mirror` (docs/reference/guests.md).
#pragma once

#include <optional>
#include <span>

#include "guest/frames.h"
#include "guest/manifest.h"
#include "guest/request.h"
#include "model/spec/spec.h"

namespace contort {

// Returns the spec with each number and each component of a vec3 changed by this fraction of its range, towards the end
// that is farther away. Parameters that the spec leaves out are changed from their default.
Spec nudged(const Spec& spec, std::span<const PlacedUse> uses);
inline constexpr double kNudge = 1e-4;

// Returns for each joint of the character the joint of the other side; a joint in the middle is its own partner.
std::vector<std::size_t> partners_of(const GuestCharacter& character);

// Returns the slot of the other side.
std::string other_slot(const GuestCharacter& character, const std::string& slot);

// The spec for the other side of the figure. Returns nothing if the manifest does not offer it: the other side lacks
// the action or the part, or a value is out of its range there.
std::optional<Spec> mirrored(const GuestManifest& manifest, const Spec& spec, std::span<const PlacedUse> uses,
                             const Character& character, const Offers& offers);

// Returns the mirror image of a motion in the plane x = 0 of our world. Each joint's rotation relative to its rest
// pose, in world axes, becomes that of its partner with y and z negated.
Motion mirror_image(const GuestCharacter& from, const Rigid& root_at_rest, const FrameLayout& layout,
                    const Motion& motion);

}  // namespace contort
