// Describes in words what a minimal spec needs in order to fail.
#pragma once

#include <string>
#include <vector>

#include "model/spec/spec.h"

namespace contort {

// Returns a text such as "crouch + pose, 2 clips, an interrupt, mech_leg_reverse as leg_left, rifle, mode dynamic, a
// blow, steps". Things that every spec has once are left out.
std::string needs_of(const Spec& spec);

// Returns the names of all actions that may be played, interrupts last, each as often as it is used.
std::vector<std::string> action_names(const Spec& spec);

}  // namespace contort
