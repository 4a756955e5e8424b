#include "corpus/replay.h"

#include "corpus/ending_case.h"

#include <algorithm>

namespace contort {

std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::same: return "same";
    case Verdict::same_family: return "same family";
    case Verdict::different: return "different";
    case Verdict::passes: return "passes";
    case Verdict::refused: return "refused";
  }
  return "";
}

namespace {

// The first frame in which two traces differ. A trace has four digits per frame of a running hash, which stays
// different after the first difference.
int first_traced_difference(const std::string& stored, const std::string& now) {
  if (stored.empty() || stored == now) return -1;
  const auto [at, other] = std::mismatch(
      stored.begin(), stored.begin() + static_cast<std::ptrdiff_t>(std::min(stored.size(), now.size())), now.begin());
  return static_cast<int>((at - stored.begin()) / 4);
}

bool as_expected(const Expectation& stored, const Expectation& now) {
  return stored.motion_hash == now.motion_hash && stored.first_frame == now.first_frame &&
         stored.worst_frame == now.worst_frame && stored.last_frame == now.last_frame && stored.depth == now.depth;
}

Replay replay_here(const Case& stored, Evaluator& evaluator, const ReplayScope& scope) {
  Replay result;
  const Result<Evaluation> run = evaluator.run(scoped(stored.spec, scope));
  if (!run) {
    result.issue = run.issue();
    return result;
  }
  const Evaluation& evaluation = *run;
  const Finding* expected = deepest(evaluation.findings, stored.expect.check, stored.expect.subject);
  const Finding* shown = expected != nullptr           ? expected
                         : evaluation.findings.empty() ? nullptr
                                                       : &evaluation.findings.front();
  result.now = expectation_of(evaluator.execution(), evaluation, shown != nullptr ? *shown : Finding{});
  result.character_changed =
      !stored.expect.character_hash.empty() && result.now.character_hash != stored.expect.character_hash;
  result.first_difference = first_traced_difference(stored.expect.trace, result.now.trace);
  if (shown == nullptr)
    result.verdict = Verdict::passes;
  else if (expected == nullptr)
    result.verdict = Verdict::different;
  else
    result.verdict = as_expected(stored.expect, result.now) ? Verdict::same : Verdict::same_family;
  return result;
}

}  // namespace

Replay replay_ending(const Case& stored, const std::function<Replay()>& work, const Isolation& isolation) {
  const Isolation limits = isolation_of(stored.expect, isolation);
  const Result<Ending> ending = isolate([&] { return work(), std::string(); }, limits);
  Replay result;
  if (!ending) {
    result.issue = ending.issue();
    return result;
  }
  if (ending->kind == Ending::Kind::finished) return work();
  result.now = ending_case(stored.spec, *ending, limits).expect;
  const bool same = result.now.check == stored.expect.check && result.now.subject == stored.expect.subject;
  result.verdict = same ? Verdict::same : Verdict::different;
  return result;
}

Replay replay(const Case& stored, Evaluator& evaluator, const ReplayScope& scope, const Isolation& isolation) {
  const auto work = [&] { return replay_here(stored, evaluator, scope); };
  return is_abnormal_exit(stored.expect) ? replay_ending(stored, work, isolation) : work();
}

}  // namespace contort
