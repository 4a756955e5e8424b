// Measures the time of a frame: generated, and generated and checked. Each benchmark prints frames per second and the
// hash of its motion, which shows if a faster version gives another result.
#include <benchmark/benchmark.h>

#include "tests/stage_evaluator.h"
#include "fuzz/draw.h"
#include "model/core/hash.h"
#include "tests/scenes.h"

namespace contort {

namespace {

void finish(benchmark::State& state, std::int64_t frames, std::uint64_t hash) {
  state.counters["frames/s"] = benchmark::Counter(static_cast<double>(frames), benchmark::Counter::kIsRate);
  state.SetLabel("motion " + to_hex(hash));
}

void generate_scene(benchmark::State& state, const char* name) {
  const Result<Stage> stage = build_stage(scene(name), stock_library());
  GenerateScratch scratch;
  Motion motion;
  std::int64_t frames = 0;
  for (auto _ : state) {
    generate(*stage, scratch, motion);
    frames += motion.frame_count;
  }
  finish(state, frames, motion_hash(motion));
}

void check_scene(benchmark::State& state, const char* name) {
  const Result<Stage> stage = build_stage(scene(name), stock_library());
  StageEvaluator evaluator;
  std::int64_t frames = 0;
  Evaluation last;
  for (auto _ : state) {
    last = evaluator.run(*stage);
    frames += last.frame_count;
  }
  finish(state, frames, last.motion_hash);
}

// The typical work of the fuzzer: many different motions, so that branch predictors do not learn one.
void check_drawn(benchmark::State& state, const char* character) {
  std::vector<Stage> stages;
  for (int i = 0; i < 256; ++i)
    if (Result<Stage> stage = build_stage(draw_spec({{character}}, stock_generator(), 7, i), stock_library()); stage)
      stages.push_back(std::move(stage).value());
  StageEvaluator evaluator;
  Hash64 hash;
  for (const Stage& stage : stages) hash.add(evaluator.run(stage).motion_hash);
  std::int64_t frames = 0;
  for (auto _ : state)
    for (const Stage& stage : stages) frames += evaluator.run(stage).frame_count;
  finish(state, frames, hash.value());
}

BENCHMARK_CAPTURE(generate_scene, mech_rifle, "mech_rifle");
BENCHMARK_CAPTURE(generate_scene, human_reaches, "human_reaches");
BENCHMARK_CAPTURE(check_scene, mech_rifle, "mech_rifle");
BENCHMARK_CAPTURE(check_scene, mech_swapped, "mech_swapped");
BENCHMARK_CAPTURE(generate_scene, mech_walk_aim, "mech_walk_aim");
BENCHMARK_CAPTURE(check_scene, mech_walk_aim, "mech_walk_aim");
BENCHMARK_CAPTURE(check_scene, human_overlaps, "human_overlaps");
BENCHMARK_CAPTURE(check_drawn, mech, "mech")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(check_drawn, human, "human")->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace contort

BENCHMARK_MAIN();
