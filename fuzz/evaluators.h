// An evaluator for each of several threads.
#pragma once

#include <memory>
#include <vector>

#include "corpus/evaluator.h"

namespace contort {

// Each worker's own generator and memory.
class Evaluators {
 public:
  Evaluators(const Generator& generator, const CheckSettings& settings, int jobs) {
    for (int i = 0; i < jobs; ++i) {
      generators_.push_back(generator.another());
      evaluators_.push_back(std::make_unique<Evaluator>(*generators_.back(), settings));
    }
  }
  Evaluator& of(int worker) { return *evaluators_[static_cast<std::size_t>(worker)]; }

 private:
  std::vector<std::unique_ptr<Generator>> generators_;
  std::vector<std::unique_ptr<Evaluator>> evaluators_;
};

}  // namespace contort
