#include "fuzz/shrink.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "fuzz/edits.h"

namespace contort {

namespace {

constexpr int kMaxRounds = 8;
constexpr int kMaxBisections = 8;

// In which frame of the motion an action begins; 0 where an interrupt may change that.
int first_frame(const Timeline& timeline, const PlannedAction& action) {
  if (!timeline.interrupts.empty()) return 0;
  int start = 0;
  for (int s = 0; s < action.sequence; ++s) start += timeline.sequences[static_cast<std::size_t>(s)].length;
  return start + action.first_frame;
}

class Shrinker {
 public:
  Shrinker(const Case& original, const Library& library, const ShrinkConfig& config)
      : library_(library), config_(config), best_(original), least_depth_(config.depth_floor * original.expect.depth), evaluator_(config.checks) {
    // Nothing finite is as deep as NaN, which a case stores with depth 0.
    if (std::isnan(original.expect.worst_margin)) least_depth_ = std::numeric_limits<double>::infinity();
    best_.provenance.shrunk_from = spec_id(original.spec);
  }

  Case run() {
    for (int round = 0; round < kMaxRounds && !spent(); ++round) {
      const Spec before = best_.spec;
      cut_time();
      for (const UnitKind& kind : unit_kinds()) remove_units(kind);
      for (const Edit& edit : default_edits(best_.spec)) try_edit(edit);
      for (const NumberRef& number : numbers_of(best_.spec)) move_number(number);
      if (best_.spec == before) break;
    }
    best_.provenance.shrink_evaluations = evaluations_;
    best_.provenance.shrink_stopped = stopped_;
    return best_;
  }

 private:
  bool spent() {
    if (evaluations_ >= config_.max_evaluations) stopped_ = "evaluations";
    if (config_.out_of_time && config_.out_of_time()) stopped_ = "time";
    return stopped_ != "fixpoint";
  }

  // Most candidates keep the character: it need not be assembled again for them.
  Result<Stage> build(const Spec& candidate) const {
    if (character_ && candidate.character == best_.spec.character) return build_stage(candidate, character_, library_);
    return build_stage(candidate, library_);
  }

  // Makes the candidate the best one if it builds, fails in the same way, and deeply enough.
  bool accept(const Spec& candidate) {
    if (candidate == best_.spec || spent()) return false;
    if (!tried_.insert(print_spec(candidate)).second) return false;
    const Result<Stage> stage = build(candidate);
    if (!stage) return false;
    ++evaluations_;
    const Evaluation evaluation = evaluator_.run(*stage, best_.expect.check);
    const Finding* finding = deepest(evaluation.findings, best_.expect.check, best_.expect.subject);
    if (finding == nullptr || finding->depth < least_depth_) return false;
    best_.spec = candidate;
    character_ = stage->character;
    best_.expect = expectation_of(*stage, evaluator_.motion(), evaluation, *finding);
    return true;
  }

  bool try_edit(const Edit& edit) {
    Spec candidate = best_.spec;
    edit(candidate);
    return accept(candidate);
  }

  // What starts after the worst frame cannot have caused it.
  void cut_time() {
    const Result<Stage> stage = build(best_.spec);
    if (!stage) return;
    Spec candidate = best_.spec;
    const std::vector<PlannedAction>& planned = stage->timeline.actions;
    for (std::size_t i = planned.size(); i-- > 0;) {  // from the end, so that indices before stay good
      if (i + 1 < planned.size() && planned[i + 1].use == planned[i].use) continue;  // one use, several parts
      if (first_frame(stage->timeline, planned[i]) <= best_.expect.worst_frame) continue;
      std::vector<ActionUse>& actions = candidate.sequences[static_cast<std::size_t>(planned[i].sequence)]
                                            .clips[static_cast<std::size_t>(planned[i].clip)]
                                            .actions;
      actions.erase(actions.begin() + planned[i].action);
    }
    candidate.hold_frames = 0;
    accept(candidate);
  }

  // Delta debugging over units of one kind: halves, quarters, … single units.
  void remove_units(const UnitKind& kind) {
    for (int chunk = std::max(1, kind.count(best_.spec) / 2); chunk >= 1; chunk /= 2)
      for (int first = 0; first < kind.count(best_.spec);) {
        const bool removed = try_edit([&](Spec& x) { kind.remove(x, first, chunk); });
        if (!removed) first += chunk;  // else the next units have moved up to `first`
      }
  }

  // Towards the preset: all the way, else by bisection between what fails and what does not; then to rounder numbers.
  void move_number(const NumberRef& number) {
    const auto set_to = [&](double value) { return try_edit([&](Spec& x) { number.at(x) = value; }); };
    if (set_to(number.preset)) return;
    double safe = number.preset;
    for (int i = 0; i < kMaxBisections; ++i) {
      const double now = number.at(best_.spec);
      const double middle = on_lattice(0.5 * (safe + now), number.steps_per_unit);
      if (middle == safe || middle == now) break;
      if (!set_to(middle)) safe = middle;
    }
    for (const double grain : {100.0, 10.0}) {
      const double now = number.at(best_.spec);
      const double coarse = number.steps_per_unit / grain;
      const double rounded = (now < 0.0 ? std::ceil(now * coarse) : std::floor(now * coarse)) / coarse + 0.0;
      if (rounded != now && set_to(rounded)) return;
    }
  }

  const Library& library_;
  const ShrinkConfig& config_;
  Case best_;
  double least_depth_;
  std::shared_ptr<const Character> character_;  // of best_, once one was accepted
  int evaluations_ = 0;
  std::string stopped_ = "fixpoint";
  std::set<std::string> tried_;
  Evaluator evaluator_;
};

}  // namespace

Case shrink(const Case& original, const Library& library, const ShrinkConfig& config) {
  return Shrinker(original, library, config).run();
}

}  // namespace contort
