#include "corpus/evaluator.h"

namespace contort {

Result<Evaluation> Evaluator::run(const Spec& spec, std::string_view only_check) {
  if (const Result<Done> done = generator_.run(spec, execution_); !done) return done.issue();
  return judge_.evaluate(execution_, only_check);
}

}  // namespace contort
