// Converts the characters of a generator's manifest to our descriptions.
#pragma once

#include "guest/manifest.h"
#include "model/character/character.h"
#include "model/character/library.h"
#include "model/motion/execution.h"

namespace contort {

// The reason that the character's file gives for allowed contacts of colliders that overlap at rest. Such colliders
// always touch, because joints that are not neighbours may still be near each other.
inline constexpr std::string_view kOverlapAtRest = "They overlap at rest.";

// A library that has only the manifest's characters. Each slot is a part of its own, and each of the names in `parts`
// is a part with the same joints. Figures without colliders are drawn as thin bones.
Library library_of(const GuestManifest& manifest);

// The names of a character's joints in our library, in the manifest's order. They are valid, unique within their slot,
// and do not contain the slot.
std::vector<std::string> joint_names(const GuestCharacter& character);

// Our joint for each joint of the manifest's character; the root is 0.
std::vector<int> joints_of(const GuestCharacter& from, const Character& character);

// The declared couplings of joints, with our joints as joints_of gives them.
std::vector<Coupling> couplings_of(const GuestCharacter& from, const std::vector<int>& joints);

// Converts the name of a slot's part to the name in our library, and back: "" if our part is the slot's first.
std::string part_name(const GuestCharacter& character, const std::string& slot, std::size_t index);
std::string part_asked_for(const GuestCharacter& character, const std::string& slot, const std::string& part);

// The root's rest pose of the manifest, in our world.
Rigid root_at_rest(const GuestManifest& manifest, std::string_view character);

const GuestCharacter* find_character(const GuestManifest& manifest, std::string_view name);

}  // namespace contort
