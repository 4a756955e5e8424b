// Shrinking: a smaller spec that fails in the same way. Works on the spec itself, never on the draw, so a case from
// anywhere can be shrunk. Deterministic: the same input gives the same output, and shrinking that again changes nothing
// (docs/internals/shrinking.md).
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "corpus/case.h"
#include "corpus/evaluator.h"
#include "process/isolate.h"
#include "fuzz/base_build.h"
#include "fuzz/trial.h"
#include "model/generator.h"

namespace contort {

// Options of a shrink on the way to the precursor (precursor.h). If the result has a precursor, free fields and the
// worst case are not computed for it.
struct PrimarySearch {
  std::optional<Spec> begin_with;  // the candidate to try first: the minimal spec of another failure of the same case
  std::set<Family> left;           // families that were shrunk before; none of them is the precursor again
};

struct ShrinkConfig {
  int max_evaluations = 2000;  // for all stages together
  // A candidate must stay at least this deep, as a fraction of the original depth. Without a floor, shrinking ends at
  // tiny violations, which look like noise.
  double depth_floor = 0.5;
  CheckSettings checks;  // the settings with which the failure was found
  Isolation isolation;   // limits for cases that end their process
  BaseBuild* base = nullptr;   // candidates must count against this build by `rules`; null: no comparison
  CompareRules rules;
  bool guarded = false;  // a candidate is known to end its process, so each is first tried in another process
  BeforeRun before_run;  // may be empty
  std::function<bool(const Spec&)> allowed;  // candidates for which it is false are not tried; may be empty
  std::optional<PrimarySearch> search;              // the caller continues with the precursor
  std::function<bool()> out_of_time;         // asked before every evaluation; may be empty. Makes results differ.
};

struct Shrunk {
  Case original;  // the original case as it was confirmed
  Case minimal;
  Case worst;                     // the structure of `minimal`, with the numbers that make the failure deepest
  std::vector<Case> met;          // for each family that the original does not show, the cheapest spec seen
  std::optional<Case> precursor;  // the precursor of `minimal` (precursor.h), in the original if that shows it, else in
                                  // `minimal`
  std::string stopped;            // fixpoint, evaluations, time; or nothing was shrunk: flaky, gone
  int evaluations = 0;            // motions generated
};

// Keeps check, subject and character of `original`. A case that ends its process (isolate.h), or a guarded one, runs in
// other processes; then the caller must have only one thread.
Shrunk shrink(const Case& original, Generator& generator, const ShrinkConfig& config);

// Shrinks with any way of running specs. The generator is needed for the limits of parameters.
Shrunk shrink_with(Trial& trial, const Case& original, Generator& generator, const ShrinkConfig& config);

}  // namespace contort
