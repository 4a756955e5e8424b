// What a case was made of, as words to be counted: "character mech", "action reach (ik) on arm_left", "action reach
// (ik) on arm_left in blend", "pair pose + reach on arm_left", "ground steps", "interrupt on contact".
#pragma once

#include <set>
#include <string>
#include <vector>

#include "generator/stage.h"
#include "model/character/library.h"
#include "model/motion/motion.h"
#include "model/spec/spec.h"

namespace contort {

// An action, and each phase in which it moved its part, once for each use; the others once. The motion is the stage's.
std::vector<std::string> labels_of(const Spec& spec, const Stage& stage, const Motion& motion);

// "action reach (ik) on arm_left", "pair pose + reach on arm_left": all that cases of this character could be made of.
std::set<std::string> possible_labels(const Character& character);

}  // namespace contort
