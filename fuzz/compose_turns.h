// Makes actions of one part wait for each other.
#pragma once

#include "model/generator.h"

namespace contort {

// Moves starts so that a clip begins when the previous one has ended, and an action when no other action moves its
// parts.
void take_turns(const Character& character, const Offers& offers, SequenceDesc& sequence);

}  // namespace contort
