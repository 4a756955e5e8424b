#include "fuzz/against_work.h"

#include <cmath>

#include "model/core/hash.h"

namespace contort {

namespace {

MeasureRequest request_for(const Spec& spec) {
  MeasureRequest request;
  request.spec = spec;
  return request;
}

// The margin of one family, below 0 if it fails; 0 if it was not judged.
double margin_in(const Measurement& measured, const Expectation& family) {
  for (const auto* list : {&measured.findings, &measured.margins})
    for (const SubjectMargin& one : *list)
      if (one.check == family.check && one.subject == family.subject && std::isfinite(one.margin)) return one.margin;
  return 0.0;
}

// Returns true if this build shows the failure again, equal in every bit.
bool is_repeated(const Case& found, Evaluator& evaluator) {
  const Result<Evaluation> again = evaluator.run(found.spec, found.expect.check);
  if (!again || deepest(again->findings, found.expect.check, found.expect.subject) == nullptr) return false;
  return to_hex(again->motion_hash) == found.expect.motion_hash;
}

}  // namespace

// Starts the base on first use, because a worker's tools are copied into its process before it runs.
BaseBuild& AgainstWork::base() {
  if (base_ == nullptr) base_ = config_.start();
  return *base_;
}

Measurement AgainstWork::measure_base(const MeasureRequest& request, WorkerSlot& slot) {
  base().ask(request);
  return base().answer([&slot] { slot.beat(); });
}

void AgainstWork::begin(const Spec& spec) {
  MeasureRequest request = request_for(spec);
  request.trace = true;
  base().ask(request);
}

Comparison AgainstWork::compare(const Spec& spec, const Evaluation& ours, const Evaluator& evaluator,
                                WorkerSlot& slot) {
  MeasureRequest request;
  request.trace = true;
  const Measurement mine = measurement_of(request, ours, evaluator);
  slot.beat();
  return contort::compare(spec.character.name, mine, base().answer([&slot] { slot.beat(); }), config_.rules);
}

void AgainstWork::drop(WorkerSlot& slot) {
  (void)base().answer([&slot] { slot.beat(); });
}

Comparison AgainstWork::compare_ending(const Spec& spec, const Family& ended, WorkerSlot& slot) {
  const Measurement base = measure_base(request_for(spec), slot);
  Comparison comparison;
  comparison.refusal = refusal_text(base);
  if (!comparison.refusal.empty()) return comparison;
  comparison.moved = true, comparison.base_hash = base.motion_hash;
  comparison.broke = {ended};
  return comparison;
}

bool AgainstWork::is_refused(const Spec& spec, WorkerSlot& slot) {
  return measure_base(request_for(spec), slot).refusal.has_value();
}

bool AgainstWork::confirm(Case& found, Evaluator& evaluator, const std::string& base_hash, WorkerSlot& slot) {
  const bool has_motion = !is_abnormal_exit(found.expect);
  if (has_motion && !is_repeated(found, evaluator)) return false;
  MeasureRequest request = request_for(found.spec);
  if (has_motion) request.check = found.expect.check, request.margins = true;
  const Measurement base = measure_base(request, slot);
  if (base.refusal || (!base_hash.empty() && base.motion_hash != base_hash)) return false;
  std::optional<BaseShows> shows = BaseShows::passes_check;
  if (has_motion)
    shows = base_shows(depth_of(found.expect), found.expect.check, found.expect.subject, base, config_.rules);
  if (!shows) return false;
  found.provenance.base = config_.base;
  found.provenance.base_shows = base_shows_name(*shows);
  found.provenance.base_margin = has_motion ? margin_in(base, found.expect) : 0.0;
  return true;
}

}  // namespace contort
