#include "corpus/replay.h"
#include "generator/built_in.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

namespace {

constexpr int kMostFrames = 12;  // longer motions are not replayed

bool is_short(const Spec& spec, const Admission& admitted) {
  return admitted.most_frames <= kMostFrames && spec.dynamics.mode == Mode::kinematic;
}

}  // namespace

bool try_case(std::string_view bytes) {
  const Result<Case> stored = parse_case(bytes);
  if (!stored) return require_clean(stored.issue()), false;
  const Result<Case> again = parse_case(print_case(*stored));
  require(again.ok() && print_case(*again) == print_case(*stored), "what is printed reads back as the same case");
  require(!print_family(family_of(*stored)).empty(), "every case is of a family");
  BuiltInGenerator generator;
  const Result<Admission> admitted = generator.admit(stored->spec);
  if (admitted.ok() && !is_short(stored->spec, *admitted)) return true;
  Evaluator evaluator(generator);
  replay(*stored, evaluator);
  return true;
}

}  // namespace contort::hostile
