#include "corpus/evaluator.h"

#include "generator/execute.h"

namespace contort {

Evaluation Evaluator::run(const Stage& stage, std::string_view only_check) {
  execute(stage, scratch_, execution_);
  return judge_.evaluate(execution_, only_check);
}

}  // namespace contort
