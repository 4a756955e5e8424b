// Changes to raw specs: overlays, corner values, swarm, and the small steps of a guided search. Each result composes to
// a spec that builds.
#pragma once

#include <cstddef>

#include "fuzz/dice.h"
#include "fuzz/raw.h"

namespace contort {

// Lists get no longer than this; those of draws are shorter still.
inline constexpr std::size_t kMostSequences = 3;
inline constexpr std::size_t kMostClips = 4;    // of a sequence
inline constexpr std::size_t kMostActions = 6;  // of a clip
inline constexpr std::size_t kMostInterrupts = 6;

// Adds all that another draw has behind what is there: its actions into the clips, its clips, sequences and
// interrupts after the others, as far as there is room. It is interrupted if one of them is, and has as many loads and
// blows as the one that has most. So more of it meets.
void overlay(RawSpec& raw, const RawSpec& mate);

// Every fourth number of actions, of times of clips, and of the ground goes to an end of its range: faults like to sit
// there, and an even draw rarely comes by.
void go_to_corners(RawSpec& raw, Dice& dice);

// Half of all features are left out (features.h).
void leave_out(RawSpec& raw, Dice& dice);

// One to three changes: a number moves a little or far or to an end; clips and actions are copied, dropped, or come
// over from `mate`.
void mutate(RawSpec& raw, const RawSpec& mate, Dice& dice);

}  // namespace contort
