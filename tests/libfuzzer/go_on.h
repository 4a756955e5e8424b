// Bounded work on an input that was read: what `check`, `replay` and `generate` would do with it.
#pragma once

#include "model/asset/asset.h"
#include "model/character/library.h"
#include "model/core/result.h"
#include "model/spec/spec.h"

namespace contort::hostile {

// A refusal must have a code and a sentence, and print as one line.
void require_clean(const Issue& issue);

// Builds, generates a few frames and judges them. False where the stage is refused.
bool play(const Spec& spec, const Library& library);

// The same as a motion of actions and as one of masses.
bool play_in_both_modes(Spec spec, const Library& library);

// Poses inside and outside of every clip, the speeds of all joints, and a few frames as the motion of a character.
void look_at(const Asset& asset);

}  // namespace contort::hostile
