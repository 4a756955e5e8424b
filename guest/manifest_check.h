// The rules of a manifest that go beyond the limits of single fields.
#pragma once

#include "guest/manifest.h"

namespace contort {

// Names are unique and refer to existing items, ranges are not empty, axes and rotations have length 1. Codes
// generator.no_character, .no_action, .duplicate_name, .bad_root, .unknown_joint, .unknown_slot, .unknown_param,
// .split_slot, .bad_axis, .bad_rotation, .bad_range, .bad_convention, .bad_choice, .bad_relation, with pointers.
Result<Done> check_manifest(const GuestManifest& manifest);

// Returns the slot of each joint, in the order of joints. Parents must come before their children.
std::vector<std::string> slots_of(const GuestCharacter& character);

// Index of the joint, or -1 if there is no such joint.
std::array<double, 2> as_two(const NumberOrTwo& value);

int find_collider(const GuestCharacter& character, std::string_view name);
int find_joint(const GuestCharacter& character, std::string_view name);

Vec3 as_three(const NumberOrThree& value);

}  // namespace contort
