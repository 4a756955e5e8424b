// Makes the intent of the built-in generator.
#pragma once

#include <span>

#include "generator/lags.h"
#include "generator/rule_runner.h"
#include "generator/stage.h"
#include "model/motion/intent.h"

namespace contort {

// Writes the intent of a motion that was generated from this stage, into reused memory. Lags are the frames in which
// parts were not at their wanted places: no goal is in force in these frames, and an action that ends in one of them
// did not meet its request.
void say_intent(const Stage& stage, const Motion& motion, const RuleRunner& rules, std::span<const Lag> lags,
                Intent& intent);

}  // namespace contort
