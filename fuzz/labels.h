// What a case was made of, as words to be counted: "character mech", "action reach (ik) on arm_left", "pair pose + reach on
// arm_left", "ground steps", "interrupt on contact".
#pragma once

#include <string>
#include <vector>

#include "generator/spec.h"
#include "generator/stage.h"

namespace contort {

// An action once for each use, the others once.
std::vector<std::string> labels_of(const Spec& spec, const Stage& stage);

}  // namespace contort
