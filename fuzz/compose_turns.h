// Actions that do not get into each other's way.
#pragma once

#include "model/character/character.h"
#include "model/spec/clip.h"

namespace contort {

// Clips begin when the one before them has ended, and an action when none moves a part of its own any more.
void take_turns(const Character& character, SequenceDesc& sequence);

}  // namespace contort
