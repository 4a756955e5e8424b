#include "fuzz/trial.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "corpus/ending_case.h"
#include "process/clock.h"
#include "process/ended.h"

namespace contort {

CheckTrial::CheckTrial(const Expectation& family, Generator& generator, const CheckSettings& settings,
                       BeforeRun before)
    : check_(family.check),
      subject_(family.subject),
      evaluator_(generator, settings),
      before_(std::move(before)) {}

TrialResult CheckTrial::run(const Spec& spec, int most_frames) {
  TrialResult shown;
  if (before_) before_(spec);
  const Result<Admission> admitted = evaluator_.generator().admit(spec);
  if (!admitted || admitted->most_frames > most_frames) return shown;
  const Result<Evaluation> evaluation = evaluator_.run(spec, check_);
  if (!evaluation) return shown;
  shown.built = true;
  shown.most_frames = admitted->most_frames;
  shown.character = evaluator_.execution().character;
  shown.spans = evaluator_.motion().spans;
  shown.met = others_among(spec, *evaluation);
  const Finding* finding = deepest(evaluation->findings, check_, subject_);
  if (finding == nullptr) return shown;
  shown.fails = true;
  shown.depth = finding->depth;
  shown.expect = expectation_of(evaluator_.execution(), *evaluation, *finding);
  return shown;
}

std::vector<Case> CheckTrial::others(const Spec& spec) {
  Evaluation evaluation;
  evaluation.motion_hash = motion_hash(evaluator_.motion());
  evaluation.findings = evaluator_.judge_by_all_checks();
  return others_among(spec, evaluation);
}

std::vector<Case> CheckTrial::others_among(const Spec& spec, const Evaluation& evaluation) const {
  std::map<Family, const Finding*> deepest_of;
  for (const Finding& finding : evaluation.findings) {
    const Finding*& deepest = deepest_of[family_of(spec.character.name, finding)];
    if (deepest == nullptr || finding.depth > deepest->depth) deepest = &finding;
  }
  std::vector<Case> cases;
  for (const auto& [family, finding] : deepest_of)
    if (finding->check != check_ || finding->subject != subject_)
      cases.push_back({spec, expectation_of(evaluator_.execution(), evaluation, *finding), {}});
  return cases;
}

GuardedTrial::GuardedTrial(Trial& inner, const Isolation& isolation, bool is_own_program)
    : inner_(inner), isolation_(isolation), is_own_program_(is_own_program) {
  isolation_.silent = true;
}

// If no process can be started, the spec runs in this one.
std::optional<Case> GuardedTrial::ended(const Spec& spec, const std::function<void()>& work) const {
  const Result<Ending> ending = isolate([&] { return work(), std::string(); }, isolation_);
  if (!ending || ending->kind == Ending::Kind::finished) return std::nullopt;
  return ending_case(spec, *ending, isolation_);
}

// Runs candidates in this process, because each process of our own would have to start the program again.
TrialResult GuardedTrial::run_here(const Spec& spec, int most_frames) {
  try {
    return inner_.run(spec, most_frames);
  } catch (const ProgramEnded& program) {
    TrialResult shown;
    shown.built = true;
    shown.met.push_back(ending_case(spec, program.ending(), isolation_));
    return shown;
  }
}

TrialResult GuardedTrial::run(const Spec& spec, int most_frames) {
  if (is_own_program_) return run_here(spec, most_frames);
  std::optional<Case> met = ended(spec, [&] { inner_.run(spec, most_frames); });
  if (!met) return inner_.run(spec, most_frames);
  TrialResult shown;
  shown.built = true;
  shown.met.push_back(std::move(*met));
  return shown;
}

std::vector<Case> GuardedTrial::others(const Spec& spec) {
  if (is_own_program_) try {
      return inner_.others(spec);
    } catch (const ProgramEnded& program) {
      return {ending_case(spec, program.ending(), isolation_)};
    }
  if (std::optional<Case> met = ended(spec, [&] { inner_.others(spec); })) return {std::move(*met)};
  return inner_.others(spec);
}

EndingTrial::EndingTrial(const Expectation& family, std::function<void(const Spec&)> work, const Isolation& isolation)
    : check_(family.check), subject_(family.subject), work_(std::move(work)), isolation_(isolation) {
  isolation_.silent = true;  // the same last output would be printed hundreds of times
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
