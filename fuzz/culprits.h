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
  std::function<void(const Spec&)> before_run;  // called with each spec before it runs; may be empty
  std::optional<Isolation> guard;               // if set, each spec first runs in a process of its own; the caller must
                                                // have one thread
};

struct FoundCause {
  Cause cause;
  std::vector<Case> met;  // experiments that ended their process; only with a guard
};

// Returns the cause of a minimal case that was shrunk. It runs one motion for each action, at most 16, and one more.
// For cases that ended their process it runs none. An experiment that ends its process shows nothing about the failure.
FoundCause find_cause(const Case& minimal, Evaluator& evaluator, const CauseSearch& search = {});

}  // namespace contort
