// The movement of a limb from its posture at an action's start to the target posture: a blend of joints, which may pass
// through other bodies, or a detour round them.
#pragma once

#include "generator/actions/action.h"

namespace contort {

// Returns true if bodies have room at seven stops on the blend of the limb from in.from to the posture.
bool has_way(const RuleInput& in, Posture& posture);

// Chooses the detour of go_round() for this posture. Returns false if no detour leaves room all the way.
bool find_way(const RuleInput& in, Posture& posture);

// Moves the limb round bodies on its path. When the action takes the part, it chooses the smallest free detour, or else
// the one with the most room. In each frame it raises the first joint by the rest of the detour. `posture` is the
// action's wanted posture. Only for courses on the layer ik, whose joints blend in.
void go_round(const RuleInput& in, Posture& posture);

}  // namespace contort
