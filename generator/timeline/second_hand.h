// Two hands on one object: an aim that knows of the other hand, which a weapon_hold brings to the object
// (docs/internals/aim.md).
#pragma once

#include "generator/timeline/timeline.h"

namespace contort {

// Tells the aims of attached objects, and the torsos that help them, of the hand that holds the same object in the same
// sequence at some time of the aim.
void pair_hands(const Character& character, Timeline& out);

}  // namespace contort
