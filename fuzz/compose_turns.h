// Actions that do not get into each other's way.
#pragma once

#include "model/generator.h"

namespace contort {

// Clips begin when the one before them has ended, and an action when none moves a part of its own any more.
void take_turns(const Character& character, const Offers& offers, SequenceDesc& sequence);

}  // namespace contort
