// Measures the time of one question to the rules that a game compiles in (docs/reference/conditions.md). Each rule has
// four comparisons, of which the last one does not hold. `night`: rules about three characters and ten actions, as a
// night leaves them. `same_action`: all rules are about the character and the action of the request.
#include <benchmark/benchmark.h>

#include "corpus/condition.h"

namespace contort {

namespace {

std::vector<Condition> rules_that_do_not_hold(int count, const std::vector<std::string>& characters,
                                              const std::vector<std::string>& actions) {
  std::vector<Condition> rules;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    Condition rule{.cause = std::to_string(i), .headline = "", .character = characters[i % characters.size()],
                   .character_hash = "", .tool = "", .learned_from = "",
                   .needs = {actions[i / characters.size() % actions.size()] + ".seconds"}};
    rule.any_of = {{{.name = "reach.seconds", .op = known::Op::below, .limit = 1.0},
                    {.name = "reach.target_m.x", .quantity = known::Quantity::per_second, .is_mirrored = true,
                     .op = known::Op::below, .limit = 10.0},
                    {.name = "reach.slot", .op = known::Op::is, .word = "arm_left"},
                    {.name = "reach.target_m.z", .op = known::Op::above, .limit = 1.0}}};
    rules.push_back(std::move(rule));
  }
  return rules;
}

void ask(benchmark::State& state, const std::vector<std::string>& characters,
         const std::vector<std::string>& actions) {
  const RuleTable table(rules_that_do_not_hold(static_cast<int>(state.range(0)), characters, actions));
  const known::Value values[] = {{"reach.slot", 0, "arm_left"}, {"reach.part", 0, "human_arm"},
                                 {"reach.seconds", 0.5},        {"reach.speed", 1.0},
                                 {"reach.blend_in_frames", -1}, {"reach.blend_out_frames", 0},
                                 {"reach.swivel_deg", 10},      {"reach.target_m.x", 0.2},
                                 {"reach.target_m.y", 1.2},     {"reach.target_m.z", 0.4}};
  for (auto _ : state) benchmark::DoNotOptimize(known::find_rule(table.rules(), {"human", values}));
}

void night(benchmark::State& state) {
  ask(state, {"human", "mech", "quadruped"},
      {"aim", "crouch", "direction", "hit_reaction", "pose", "reach", "run", "squat", "turn", "walk"});
}
BENCHMARK(night)->Arg(30)->Arg(60);

void same_action(benchmark::State& state) { ask(state, {"human"}, {"reach"}); }
BENCHMARK(same_action)->Arg(1)->Arg(10);

}  // namespace

}  // namespace contort

BENCHMARK_MAIN();
