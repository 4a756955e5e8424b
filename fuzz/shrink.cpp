#include "fuzz/shrink.h"

#include <algorithm>

#include "fuzz/explain.h"
#include "fuzz/shrink_stages.h"
#include "fuzz/shrink_state.h"
#include "fuzz/worst.h"

namespace contort {

namespace {

constexpr int kShortFrames = 240;  // whatever explaining and climbing try may be as long

// Every change makes the spec smaller (fewer units, else fewer fields that are not at their defaults, else nearer to
// them), so this ends; and at its end no stage had anything left to do, so that shrinking again changes nothing.
void make_minimal(ShrinkState& state) {
  while (!state.halted()) {
    const Spec before = state.spec();
    cut_time(state);
    try_stock(state);
    remove_structure(state);
    queue_interrupts(state);
    reset_fields(state);
    lower_numbers(state);
    if (state.spec() == before) try_pairs(state);
    if (state.spec() == before) return;
  }
}

// The case was minimal before: who made it so stays on record.
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
  return from;
}

}  // namespace

Shrunk shrink_with(Trial& trial, const Case& original, const Library& library, const ShrinkConfig& config) {
  ShrinkState state(trial, original, config);
  Case confirmed = original;
  if (state.confirm()) {
    confirmed.expect = state.best().expect;
    make_minimal(state);
  }
  Shrunk shrunk;
  shrunk.stopped = state.stopped();
  shrunk.minimal = shrunk.worst = state.best();
  if (shrunk.stopped == "fixpoint") {
    state.look_around();
    state.allow_frames(std::max(kShortFrames, 2 * state.shown().most_frames));
    shrunk.minimal.free_fields = free_fields_of(state, library);
    shrunk.worst = worst_of(state);
  }
  shrunk.minimal.provenance = shrunk.worst.provenance = provenance_of(confirmed, state, shrunk.stopped);
  shrunk.met = state.met();
  shrunk.minimal.also = is_as_it_was(original, state.best()) ? original.also : state.still_shown();
  shrunk.evaluations = state.evaluations();
  return shrunk;
}

Shrunk shrink(const Case& original, const Library& library, const ShrinkConfig& config) {
  if (!is_ending(original.expect)) {
    CheckTrial trial(original.expect, library, config.checks, config.before_run);
    GuardedTrial guarded(trial, config.isolation);
    return shrink_with(config.guarded ? static_cast<Trial&>(guarded) : trial, original, library, config);
  }
  const auto work = [&](const Spec& spec) {
    if (config.before_run) config.before_run(spec);
    if (const Result<Stage> stage = build_stage(spec, library)) Evaluator(config.checks).run(*stage);
  };
  EndingTrial trial(original.expect, work, isolation_of(original.expect, config.isolation));
  return shrink_with(trial, original, library, config);
}

}  // namespace contort
