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
  int draws = 300;     // cases to learn from; up to three times as many until a rule holds
  int fresh = 60;      // fresh cases to try a rule on, for each of its sides
  int jobs = 1;        // threads; the result does not depend on it
  std::string tool{};  // version of Contort, for Condition::tool
};

// If this many draws take too long, no condition is learned.
inline constexpr int kMostLateDraws = 4;

// Returns true if rules can be learned for the cause. They cannot for crashes, timeouts, recordings and swapped parts.
bool can_have_condition(const Case& minimal);

// Returns the condition of a cause on the character of its minimal case; it has no rule if none held on fresh cases.
// Codes of Generator::admit if the minimal case is refused; explain.program_ended if a program under test ends or is
// late in so many draws that too few remain.
Result<Condition> find_condition(const Case& minimal, Generator& generator, const CheckSettings& settings,
                                 const ConditionSearch& search);

}  // namespace contort
