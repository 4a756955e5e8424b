// Says in words for people what a minimal spec needs in order to fail.
#pragma once

#include <string>
#include <vector>

#include "model/spec/spec.h"

namespace contort {

// "crouch + pose, 2 clips, an interrupt, mech_leg_reverse as leg_left, rifle, mode dynamic, a blow, steps". What every
// spec has, or has one of, goes without saying.
std::string needs_of(const Spec& spec);

// The names of all actions that may be played, interrupts last; each as often as it is used.
std::vector<std::string> action_names(const Spec& spec);

}  // namespace contort
