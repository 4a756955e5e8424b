// The built-in generator says what it meant.
#pragma once

#include <span>

#include "generator/lags.h"
#include "generator/rule_runner.h"
#include "generator/stage.h"
#include "model/motion/intent.h"

namespace contort {

// The intent of a motion that was generated from this stage, into memory that is used again. Lags say where parts were
// not where they were wanted: no goal is in force in these frames, and an action that ends in one of them did not meet
// its request.
void say_intent(const Stage& stage, const Motion& motion, const RuleRunner& rules, std::span<const Lag> lags,
                Intent& intent);

}  // namespace contort
