// The one path from a Stage to findings; the fuzzer, the shrinker, replay and the command line all take it.
#pragma once

#include <cstdint>
#include <vector>

#include "checks/check.h"
#include "generator/generate.h"
#include "generator/stage.h"

namespace contort {

struct Evaluation {
  std::uint64_t motion_hash = 0;
  int frame_count = 0;
  std::vector<Finding> findings;  // by first frame, then check in the manifest's order, then subject
  bool operator==(const Evaluation&) const = default;
};

// Owns the memory of one thread's evaluations; nothing of one evaluation reaches the next.
class Evaluator {
 public:
  explicit Evaluator(CheckSettings settings = {}) : settings_(settings) {}

  // Generates, measures, folds.
  Evaluation run(const Stage& stage);

  // The same checks on a motion from elsewhere.
  std::vector<Finding> judge(const Character& character, const Motion& motion);

  const Motion& motion() const { return motion_; }  // of the last run

 private:
  CheckSettings settings_;
  GenerateScratch scratch_;
  Motion motion_;
  std::vector<Rigid> world_;
};

// The deepest finding of a check and subject, or nullptr.
const Finding* deepest(const std::vector<Finding>& findings, const std::string& check, const std::string& subject);

}  // namespace contort
