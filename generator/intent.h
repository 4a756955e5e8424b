// The built-in generator says what it meant.
#pragma once

#include "generator/stage.h"
#include "model/motion/intent.h"

namespace contort {

// The intent of a motion that was generated from this stage.
Intent intent_of(const Stage& stage, const Motion& motion);

// The same into memory that is used again.
void say_intent(const Stage& stage, const Motion& motion, Intent& intent);

}  // namespace contort
