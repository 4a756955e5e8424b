// The joints of a model file that a manifest names.
#pragma once

#include <span>
#include <string>

#include "guest/manifest.h"
#include "model/core/result.h"

namespace contort {

// Returns the character with only these joints, in this order. Each becomes a child of its nearest listed ancestor and
// keeps its place at rest. Colliders of joints that are left out move to the nearest listed ancestor, too. Code
// generator.unknown_joint, with a pointer into the names: "/joints/3/name".
Result<GuestCharacter> with_joints(const GuestCharacter& from, std::span<const std::string> names);

}  // namespace contort
