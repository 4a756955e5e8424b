// Rates the postures in which two hands can hold one object (docs/internals/aim.md), so that an aim can choose one.
#pragma once

#include "generator/actions/action.h"

namespace contort {

// A measure of how awkward it is to hold the object as the aim's chain, which is placed, holds it: leaning to a side, far
// from the shoulder, with elbow or grip raised, and away from three quarters of the other arm's reach.
double awkwardness_of_two_hands(const RuleInput& in);

// The faults that the other arm has where its hand holds the object, in the best turn of its elbow; 0 where it holds it
// without any: in reach, joints in their ranges, and room for its bodies. The aiming limb is placed in in.world; the
// other arm's coordinates in `posture` are scratch.
double fault_of_second_hand(const RuleInput& in, Posture& posture);

}  // namespace contort
