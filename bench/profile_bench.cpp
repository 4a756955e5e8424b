// Does the work of a fuzzer's worker on the cases that a profile draws, in one process: draw, build, generate and
// check. bench/profile.sh counts its instructions.
//
// contort_profile_bench PROFILE CHARACTER CASES
#include <cstdio>
#include <cstdlib>

#include "bench/side_by_side.h"
#include "fuzz/draw.h"
#include "model/core/hash.h"
#include "tests/stage_evaluator.h"

int main(int argc, char** argv) {
  using namespace contort;
  if (argc != 4) return std::fprintf(stderr, "usage: contort_profile_bench PROFILE CHARACTER CASES\n"), 2;
  const DrawConfig config{{argv[2]}, load_profile(argv[1]).value()};
  StageEvaluator evaluator;
  std::int64_t frames = 0;
  Hash64 motions;
  stock_generator(), stock_library();
  const double begin_s = thread_time_s();
  for (int i = 0; i < std::atoi(argv[3]); ++i) {
    const Result<Stage> stage = build_stage(draw_spec(config, stock_generator(), 7, i), stock_library());
    if (!stage) continue;
    const Evaluation evaluation = evaluator.run(*stage);
    frames += evaluation.frame_count, motions.add(evaluation.motion_hash);
  }
  std::printf("%lld frames, %.0f a second, motions %s\n", static_cast<long long>(frames),
              static_cast<double>(frames) / (thread_time_s() - begin_s), to_hex(motions.value()).c_str());
}
