// Finds the cause of a failure by experiments on its minimal case: each of its actions is played alone.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "corpus/case.h"
#include "corpus/cause.h"
#include "corpus/evaluator.h"
#include "process/isolate.h"

namespace contort {

struct CauseSearch {
  std::function<void(const Spec&)> before_run;  // is told each spec before it runs; may be empty
  std::optional<Isolation> guard;               // each spec runs in a process of its own first; one thread only
};

struct FoundCause {
  Cause cause;
  std::vector<Case> met;  // experiments that ended their process; only with a guard
};

// The cause of a minimal case that was shrunk. Runs one motion for each action, at most 16, and one more, and nothing
// for cases that ended their process. An experiment that ends its process shows nothing about the failure.
FoundCause find_cause(const Case& minimal, Evaluator& evaluator, const CauseSearch& search = {});

}  // namespace contort
