// Finds the condition under which a cause shows, by drawing requests like its minimal case.
// docs/reference/conditions.md describes the draws, the learning and the trial.
#pragma once

#include <string>

#include "checks/settings.h"
#include "corpus/case.h"
#include "corpus/condition.h"
#include "model/generator.h"

namespace contort {

struct ConditionSearch {
  int draws = 300;     // to learn from; up to three times as many while they are too few for a rule that holds
  int fresh = 60;      // to try a rule on, for each of its sides
  int jobs = 1;        // threads; the result does not depend on it
  std::string tool{};  // build that learns, for Condition::tool
};

// Whether rules can be learned for a cause: not for crashes, timeouts, recordings and swapped parts.
bool can_have_condition(const Case& minimal);

// The condition of a cause on the character of its minimal case; without a rule if none held on fresh cases. Codes of
// Generator::admit if the minimal case is refused.
Result<Condition> find_condition(const Case& minimal, Generator& generator, const CheckSettings& settings,
                                 const ConditionSearch& search);

}  // namespace contort
