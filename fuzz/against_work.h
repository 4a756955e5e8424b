// A worker's part in a comparison of two builds: it runs the base and says which failures count.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "corpus/case.h"
#include "fuzz/base_build.h"
#include "process/worker_pool.h"

namespace contort {

// The base of one worker. It starts at the first spec.
class AgainstWork {
 public:
  explicit AgainstWork(const AgainstConfig& config) : config_(config) {}

  // Has the base begin with the spec, while this process runs it. compare() or drop() must follow.
  void begin(const Spec& spec);
  Comparison compare(const Spec& spec, const Evaluation& ours, const Evaluator& evaluator, WorkerSlot& slot);
  void drop(WorkerSlot& slot);

  // Returns the comparison for a case that ends this build as `ended` says: the family broke if the base has an answer.
  Comparison compare_ending(const Spec& spec, const Family& ended, WorkerSlot& slot);

  // Runs the case in both builds once more. Returns true if this build repeats its motion, the base repeats `base_hash`
  // (any, if that is empty), and the failure counts. The provenance then says what the base shows. A case that ended
  // this build is run only by the base.
  bool confirm(Case& found, Evaluator& evaluator, const std::string& base_hash, WorkerSlot& slot);

  // Returns true if the spec ends the base, or if the base refuses it.
  bool is_refused(const Spec& spec, WorkerSlot& slot);

  BaseBuild& base();
  const CompareRules& rules() const { return config_.rules; }

 private:
  Measurement measure_base(const MeasureRequest& request, WorkerSlot& slot);

  const AgainstConfig& config_;
  std::shared_ptr<BaseBuild> base_;
};

}  // namespace contort
