// Makes an Execution from a Stage: the motion, and the generator's intent.
#pragma once

#include "generator/generate.h"
#include "model/motion/execution.h"

namespace contort {

// Cannot fail, like generate(). Overwrites `execution` and reuses its memory.
void execute(const Stage& stage, GenerateScratch& scratch, Execution& execution);

// Returns only the intent.
Intent intent_of(const Stage& stage);

}  // namespace contort
