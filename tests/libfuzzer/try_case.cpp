#include "corpus/replay.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

namespace {

constexpr int kMostFrames = 12;  // of what is replayed: all of a motion, or nothing

bool is_short(const Stage& stage) { return stage.most_frames <= kMostFrames && !stage.dynamics; }

}  // namespace

bool try_case(std::string_view bytes) {
  const Result<Case> stored = parse_case(bytes);
  if (!stored) return require_clean(stored.issue()), false;
  const Result<Case> again = parse_case(print_case(*stored));
  require(again.ok() && print_case(*again) == print_case(*stored), "what is printed reads back as the same case");
  require(!family_of(*stored).empty(), "every case is of a family");
  const Result<Stage> stage = build_stage(stored->spec, stock_library());
  if (stage.ok() && !is_short(*stage)) return true;
  Evaluator evaluator;
  replay(*stored, stock_library(), evaluator);
  return true;
}

}  // namespace contort::hostile
