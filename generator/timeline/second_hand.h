// Two hands on one object: an aim takes the other hand into account, which a weapon_hold brings to the object
// (docs/internals/aim.md).
#pragma once

#include "generator/timeline/timeline.h"

namespace contort {

// Sets in the aims of attached objects, and in the torsos that help them, the hand that holds the same object in the
// same sequence at some time of the aim.
void pair_hands(const Character& character, Timeline& out);

}  // namespace contort
