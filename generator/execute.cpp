#include "generator/execute.h"

#include "generator/intent.h"

namespace contort {

void execute(const Stage& stage, GenerateScratch& scratch, Execution& execution) {
  execution.character = stage.character;
  execution.environment = stage.environment;
  generate(stage, scratch, execution.motion);
  if (!execution.intent) execution.intent.emplace();
  say_intent(stage, execution.motion, scratch.rules, scratch.lags.lags(), *execution.intent);
  execution.intent->grasps = scratch.grasps.grasps();
}

Intent intent_of(const Stage& stage) {
  GenerateScratch scratch;
  Execution execution;
  execute(stage, scratch, execution);
  return *execution.intent;
}

}  // namespace contort
