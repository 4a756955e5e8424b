#include "fuzz/shrink.h"

#include <algorithm>

#include "corpus/ending_case.h"
#include "fuzz/against_trial.h"
#include "fuzz/explain.h"
#include "fuzz/precursor.h"
#include "fuzz/shrink_stages.h"
#include "fuzz/shrink_state.h"
#include "fuzz/worst.h"

namespace contort {

namespace {

// Most frames of the motions that the searches for free fields and for the deepest failure may try.
constexpr int kShortFrames = 240;

// This terminates: every change makes the spec smaller (fewer units, else fewer fields that are not at their defaults,
// else values nearer to them). At the end no stage can change anything, so shrinking again changes nothing.
void make_minimal(ShrinkState& state) {
  while (!state.halted()) {
    const Spec before = state.spec();
    for (const auto stage : {cut_time, try_stock, remove_structure, queue_interrupts, reset_fields, lower_numbers})
      if (!state.halted()) stage(state);
    if (state.spec() == before && !state.halted()) try_pairs(state);
    if (state.spec() == before) return;
  }
}

// True if the case was already minimal; its provenance is then kept.
bool is_as_it_was(const Case& original, const Case& minimal) {
  const Provenance& from = original.provenance;
  return !from.shrunk_from.empty() && from.shrink_stopped == "fixpoint" && minimal.spec == original.spec;
}

Provenance provenance_of(const Case& original, const ShrinkState& state, const std::string& stopped) {
  if (is_as_it_was(original, state.best())) return original.provenance;
  Provenance from = original.provenance;
  if (from.shrunk_from.empty()) {
    from.shrunk_from = spec_id(original.spec);
    from.original_depth = original.expect.depth;
  }
  from.shrink_evaluations = state.evaluations();
  from.shrink_stopped = stopped;
  // These describe the unshrunk spec; the run sets them again.
  from.base.clear(), from.base_shows.clear(), from.base_margin = 0.0;
  return from;
}

// Completes a minimal spec: its precursor, its free fields and its worst case.
void look_closer(Shrunk& shrunk, ShrinkState& state, const std::vector<Case>& others, const ShrinkConfig& config) {
  for (const Case& other : others) state.meet(other);
  const Case* precursor = precursor_of(shrunk.minimal, others, config.search.value_or(PrimarySearch{}).left);
  if (precursor != nullptr) shrunk.precursor = state.before(*precursor);
  if (shrunk.precursor && config.search) return;
  state.allow_frames(std::max(kShortFrames, 2 * state.shown().most_frames));
  shrunk.minimal.free_fields = free_fields_of(state);
  shrunk.worst = worst_of(state);
}

}  // namespace

Shrunk shrink_with(Trial& trial, const Case& original, Generator& generator, const ShrinkConfig& config) {
  ShrinkState state(trial, original, generator, config);
  Shrunk shrunk;
  shrunk.original = original;
  std::vector<Case> others;
  if (state.confirm()) {
    shrunk.original.expect = state.best().expect;
    if (config.search && config.search->begin_with) state.accept(*config.search->begin_with);
    make_minimal(state);
    others = state.others();
  }
  shrunk.stopped = state.stopped();
  shrunk.minimal = shrunk.worst = state.best();
  shrunk.minimal.co_failures = is_as_it_was(original, state.best()) ? original.co_failures : state.still_shown(others);
  if (shrunk.stopped == "fixpoint") look_closer(shrunk, state, others, config);
  shrunk.minimal.provenance = shrunk.worst.provenance = provenance_of(shrunk.original, state, shrunk.stopped);
  shrunk.met = state.met();
  shrunk.evaluations = state.evaluations();
  return shrunk;
}

namespace {

Shrunk shrink_against(Trial& trial, const Case& original, Generator& generator, const ShrinkConfig& config) {
  if (config.base == nullptr) return shrink_with(trial, original, generator, config);
  AgainstTrial both(trial, original.expect, *config.base, config.rules, config.out_of_time);
  return shrink_with(both, original, generator, config);
}

}  // namespace

Shrunk shrink(const Case& original, Generator& generator, const ShrinkConfig& config) {
  if (!is_abnormal_exit(original.expect)) {
    CheckTrial trial(original.expect, generator, config.checks, config.before_run);
    GuardedTrial guarded(trial, config.isolation, is_own_program(generator.manifest()));
    return shrink_against(config.guarded ? static_cast<Trial&>(guarded) : trial, original, generator, config);
  }
  const auto work = [&](const Spec& spec) {
    if (config.before_run) config.before_run(spec);
    (void)Evaluator(generator, config.checks).run(spec);  // only the ending of the process matters
  };
  EndingTrial trial(original.expect, work, isolation_of(original.expect, config.isolation));
  return shrink_against(trial, original, generator, config);
}

}  // namespace contort
