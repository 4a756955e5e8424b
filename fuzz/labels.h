// The ingredients of a case, as words to be counted: "character mech", "action reach (ik) on arm_left", "action reach
// (ik) on arm_left in blend", "pair pose + reach on arm_left", "ground steps", "interrupt on contact".
#pragma once

#include <set>
#include <string>
#include <vector>

#include "model/generator.h"

namespace contort {

// An action, and each phase in which it moved its part, once for each use; the others once. The execution is the
// spec's; phases and pairs are known where the generator says its intent.
std::vector<std::string> labels_of(const Spec& spec, Generator& generator, const Execution& execution);

// "action reach (ik) on arm_left", "pair pose + reach on arm_left": all that cases of this character could be made of.
std::set<std::string> possible_labels(Generator& generator, const Character& character);

}  // namespace contort
