// Shrinking: a smaller spec that fails in the same way. Works on the spec itself, never on the draw, so a case from
// anywhere can be shrunk. Deterministic: the same input gives the same output.
#pragma once

#include <functional>
#include <string>

#include "checks/evaluate.h"
#include "corpus/case.h"
#include "generator/character/library.h"

namespace contort {

struct ShrinkConfig {
  int max_evaluations = 300;
  // A candidate must stay at least this deep, as a share of the original depth: without a floor, shrinking ends at
  // violations by a hair, which look like noise.
  double depth_floor = 0.5;
  CheckSettings checks;  // those that found the failure
  std::function<bool()> out_of_time;  // asked before every evaluation; may be empty
};

// Keeps check, subject and character of `original`; its spec and expectation become those of the smaller one. Order:
// cut what comes after the failure, remove sequences, clips, actions, attachments, swaps and parameters (delta
// debugging: Zeller and Hildebrandt 2002), set fields to their defaults, move numbers towards theirs.
Case shrink(const Case& original, const Library& library, const ShrinkConfig& config);

}  // namespace contort
