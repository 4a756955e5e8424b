// Rates the postures in which two hands can hold one object (docs/internals/aim.md), so that an aim can choose one.
#pragma once

#include "generator/actions/action.h"

namespace contort {

// A measure of the awkwardness of holding the object as the placed chain of the aim does: leaning to a side, far from
// the shoulder, with elbow or grip raised, and away from three quarters of the other arm's reach.
double awkwardness_of_two_hands(const RuleInput& in);

// The faults of the other arm with its hand on the object, at the best rotation of its elbow; 0 if it is in reach, with
// joints in their ranges and room for its bodies. The aiming limb is placed in in.world; the other arm's coordinates in
// `posture` are scratch.
double fault_of_second_hand(const RuleInput& in, Posture& posture);

}  // namespace contort
