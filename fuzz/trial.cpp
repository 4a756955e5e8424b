#include "fuzz/trial.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "corpus/ending_case.h"
#include "process/clock.h"

namespace contort {

CheckTrial::CheckTrial(const Expectation& family, const Library& library, const CheckSettings& settings,
                       BeforeRun before)
    : check_(family.check),
      subject_(family.subject),
      library_(library),
      evaluator_(settings),
      before_(std::move(before)) {}

// Most candidates keep the character: it need not be assembled again for them.
Result<Stage> CheckTrial::build(const Spec& spec) const {
  if (stage_.ok() && spec.character == choice_) return build_stage(spec, stage_->character, library_);
  return build_stage(spec, library_);
}

TrialResult CheckTrial::run(const Spec& spec, int most_frames) {
  TrialResult shown;
  if (before_) before_(spec);
  Result<Stage> stage = build(spec);
  if (!stage || stage->most_frames > most_frames) return shown;
  stage_ = std::move(stage);
  choice_ = spec.character;
  shown.built = true;
  shown.most_frames = stage_->most_frames;
  shown.character = stage_->character;
  const Evaluation evaluation = evaluator_.run(*stage_, check_);
  shown.spans = evaluator_.motion().spans;
  shown.met = others_among(spec, evaluation);
  const Finding* finding = deepest(evaluation.findings, check_, subject_);
  if (finding == nullptr) return shown;
  shown.fails = true;
  shown.depth = finding->depth;
  shown.expect = expectation_of(*stage_, evaluator_.motion(), evaluation, *finding);
  return shown;
}

std::vector<Case> CheckTrial::others(const Spec& spec) {
  const Execution& execution = evaluator_.execution();
  Evaluation evaluation;
  evaluation.motion_hash = motion_hash(execution.motion);
  evaluation.findings =
      evaluator_.judge(*execution.character, execution.motion, {}, execution.environment, execution.said());
  return others_among(spec, evaluation);
}

std::vector<Case> CheckTrial::others_among(const Spec& spec, const Evaluation& evaluation) const {
  std::map<std::string, const Finding*> deepest_of;
  for (const Finding& finding : evaluation.findings) {
    const Finding*& deepest = deepest_of[family_of(spec.character.name, finding)];
    if (deepest == nullptr || finding.depth > deepest->depth) deepest = &finding;
  }
  std::vector<Case> cases;
  for (const auto& [family, finding] : deepest_of)
    if (finding->check != check_ || finding->subject != subject_)
      cases.push_back({spec, expectation_of(*stage_, evaluator_.motion(), evaluation, *finding), {}});
  return cases;
}

GuardedTrial::GuardedTrial(Trial& inner, const Isolation& isolation) : inner_(inner), isolation_(isolation) {
  isolation_.silent = true;
}

// Where no process can be had, the spec is run in this one as ever.
std::optional<Case> GuardedTrial::ended(const Spec& spec, const std::function<void()>& work) const {
  const Result<Ending> ending = isolate([&] { return work(), std::string(); }, isolation_);
  if (!ending || ending->kind == Ending::Kind::finished) return std::nullopt;
  return ending_case(spec, *ending, isolation_);
}

TrialResult GuardedTrial::run(const Spec& spec, int most_frames) {
  std::optional<Case> met = ended(spec, [&] { inner_.run(spec, most_frames); });
  if (!met) return inner_.run(spec, most_frames);
  TrialResult shown;
  shown.built = true;
  shown.met.push_back(std::move(*met));
  return shown;
}

std::vector<Case> GuardedTrial::others(const Spec& spec) {
  if (std::optional<Case> met = ended(spec, [&] { inner_.others(spec); })) return {std::move(*met)};
  return inner_.others(spec);
}

EndingTrial::EndingTrial(const Expectation& family, std::function<void(const Spec&)> work, const Isolation& isolation)
    : check_(family.check), subject_(family.subject), work_(std::move(work)), isolation_(isolation) {
  isolation_.silent = true;  // hundreds of times the same last words
}

TrialResult EndingTrial::run(const Spec& spec, int) {
  const double start_s = steady_s();
  const Result<Ending> ending = isolate([&] { return work_(spec), std::string(); }, isolation_);
  const double took_s = steady_s() - start_s;
  TrialResult shown;
  if (!ending) return shown;
  if (!timed_ && ending->kind != Ending::Kind::timeout)
    isolation_.seconds = std::max(5, static_cast<int>(std::ceil(10.0 * took_s)));
  timed_ = true;
  shown.built = true;
  if (ending->kind == Ending::Kind::finished) return shown;
  const Case ended = ending_case(spec, *ending, isolation_);
  shown.fails = ended.expect.check == check_ && ended.expect.subject == subject_;
  if (!shown.fails) shown.met.push_back(ended);
  shown.depth = ended.expect.depth;
  shown.expect = ended.expect;
  return shown;
}

}  // namespace contort
