// Finds the cause of a failure by experiments on its minimal case: each of its actions is played alone.
#pragma once

#include <functional>

#include "corpus/case.h"
#include "corpus/cause.h"
#include "corpus/evaluator.h"

namespace contort {

// The cause of a minimal case that was shrunk. `before_run` is told each spec before it runs; it may be empty. Runs
// one motion for each action, at most 16, and one more, and nothing for cases that ended their process.
Cause find_cause(const Case& minimal, Evaluator& evaluator, const std::function<void(const Spec&)>& before_run = {});

}  // namespace contort
