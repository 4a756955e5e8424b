// The ingredients of a case, as words to be counted: "character mech", "action reach (ik) on arm_left", "action reach
// (ik) on arm_left in blend", "pair pose + reach on arm_left", "ground steps", "interrupt on contact".
#pragma once

#include <set>
#include <string>
#include <vector>

#include "checks/check.h"
#include "model/generator.h"

namespace contort {

// Returns the labels of a spec and its execution. An action, and each phase in which it moved its part, is listed once
// for each use; all other labels once. Phases and pairs are known only if the generator gives an intent.
std::vector<std::string> labels_of(const Spec& spec, Generator& generator, const Execution& execution);

// Returns all labels of actions and pairs that cases of this character could have, such as "action reach (ik) on
// arm_left" and "pair pose + reach on arm_left".
std::set<std::string> possible_labels(Generator& generator, const Character& character);

// Returns the requests that the generator could not meet, each kind once, with the name of the reason: "reach on
// arm_left: out_of_reach".
std::vector<std::string> unmet_labels(const Execution& execution);

// Returns the checks that could not judge a motion, with the reason: "balance: the motion has no dynamics".
std::vector<std::string> not_judged_labels(const std::vector<NotJudged>& not_judged);

}  // namespace contort
