// Changes to raw specs: overlays, corner values, swarm, and the small steps of a guided search. Each result composes to
// a spec that builds.
#pragma once

#include <cstddef>

#include "fuzz/dice.h"
#include "fuzz/raw.h"

namespace contort {

// The greatest lengths of lists; lists of draws are shorter.
inline constexpr std::size_t kMostSequences = 3;
inline constexpr std::size_t kMostClips = 4;    // the most clips in a sequence
inline constexpr std::size_t kMostActions = 6;  // the most actions in a clip
inline constexpr std::size_t kMostInterrupts = 6;

// Overlays another draw, so that more features meet in one case. Its actions are appended to the clips, and its clips,
// sequences and interrupts to the present ones, as far as there is room. The result has interrupts if one of the two
// has them, and as many loads and blows as the one with more of them.
void overlay(RawSpec& raw, const RawSpec& mate);

// Sets every fourth number of actions, of times of clips, and of the ground to an end of its range: many faults are at
// the ends, which evenly drawn numbers rarely reach.
void go_to_corners(RawSpec& raw, Dice& dice);

// Leaves out half of all features (features.h).
void leave_out(RawSpec& raw, Dice& dice);

// Makes one to three changes: a number moves a little, far or to an end; clips and actions are copied, removed, or
// taken from `mate`.
void mutate(RawSpec& raw, const RawSpec& mate, Dice& dice);

}  // namespace contort
