// Changes to raw specs: overlays, corner values, swarm, and the small steps of a guided search. Each result composes to
// a spec that builds.
#pragma once

#include <cstddef>

#include "fuzz/dice.h"
#include "fuzz/raw.h"

namespace contort {

// The greatest lengths of lists; lists of draws are shorter.
inline constexpr std::size_t kMostSequences = 3;
inline constexpr std::size_t kMostClips = 4;    // of a sequence
inline constexpr std::size_t kMostActions = 6;  // of a clip
inline constexpr std::size_t kMostInterrupts = 6;

// Appends everything that another draw has: its actions to the clips, and its clips, sequences and interrupts after the
// present ones, as far as there is room. The result is interrupted if one of the two is, and has as many loads and
// blows as the one with more of them. So more features meet in one case.
void overlay(RawSpec& raw, const RawSpec& mate);

// Sets every fourth number of actions, of times of clips, and of the ground to an end of its range: many faults are
// there, and even draws rarely are.
void go_to_corners(RawSpec& raw, Dice& dice);

// Leaves out half of all features (features.h).
void leave_out(RawSpec& raw, Dice& dice);

// Makes one to three changes: a number moves a little, far or to an end; clips and actions are copied, removed, or
// taken from `mate`.
void mutate(RawSpec& raw, const RawSpec& mate, Dice& dice);

}  // namespace contort
