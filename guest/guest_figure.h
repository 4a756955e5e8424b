// The characters of a generator's manifest as descriptions of ours.
#pragma once

#include "guest/manifest.h"
#include "model/character/character.h"
#include "model/character/library.h"

namespace contort {

// A library of the manifest's characters alone. A slot of joints is a part of its own; each of the names in `parts` is
// one with the same joints. Figures without colliders are drawn as thin bones.
// Colliders that overlap at rest always do, as joints that are not neighbours may still be near each other. They are
// allowed to touch, for this reason.
inline constexpr std::string_view kOverlapAtRest = "They overlap at rest.";
Library library_of(const GuestManifest& manifest);

// The names of a character's joints in our library: legal, unique within their slot, and without it, in the manifest's
// order.
std::vector<std::string> joint_names(const GuestCharacter& character);

// For each joint of the manifest's character our joint; the root is 0.
std::vector<int> joints_of(const GuestCharacter& from, const Character& character);

// The name of a slot's part in our library, and back: "" where our part is the slot's first.
std::string part_name(const GuestCharacter& character, const std::string& slot, std::size_t index);
std::string part_asked_for(const GuestCharacter& character, const std::string& slot, const std::string& part);

// The root at rest as the manifest has it, in our world.
Rigid root_at_rest(const GuestManifest& manifest, std::string_view character);

const GuestCharacter* find_character(const GuestManifest& manifest, std::string_view name);

}  // namespace contort
