// Changes to raw specs: corner values, swarm, and the small steps of a guided search. Each result composes to a spec
// that builds.
#pragma once

#include "fuzz/dice.h"
#include "fuzz/raw.h"

namespace contort {

// Every fourth number goes to an end of its range: faults like to sit there, and an even draw rarely comes by.
void go_to_corners(RawSpec& raw, Dice& dice);

// Half of all features are left out (features.h).
void leave_out(RawSpec& raw, Dice& dice);

// One to three changes: a number moves a little or far or to an end; clips and actions are copied, dropped, or come over
// from `mate`.
void mutate(RawSpec& raw, const RawSpec& mate, Dice& dice);

}  // namespace contort
