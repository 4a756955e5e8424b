#include "corpus/verify.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "model/core/hash.h"

namespace contort {

namespace {

// Compares no margins: they follow from the motion, and NaN is not equal to itself.
bool equal(const Replay& a, const Replay& b) {
  const auto shown = [](const Replay& r) {
    return std::tie(r.verdict, r.now.motion_hash, r.now.check, r.now.subject, r.now.first_frame, r.now.worst_frame,
                    r.now.last_frame, r.issue.code);
  };
  return shown(a) == shown(b);
}

bool fails(const Replay& replay) { return replay.verdict == Verdict::same || replay.verdict == Verdict::same_family; }

// Adds the case. Returns true if all of its runs were equal.
bool replay_case(const Bucket& bucket, const Corpus::Stored& of_bucket, const RunCase& run,
                 std::vector<CaseReplay>& out) {
  CaseReplay one{of_bucket.path, {}, {}};
  const Result<Case>& stored = of_bucket.stored;
  bool steady = true;
  if (!stored) {
    one.result.issue = stored.issue();
  } else {
    one.family = family_of(*stored);
    one.result = run(*stored);
    const int again = bucket.state == BucketState::flaky ? 2 : one.result.verdict == Verdict::same ? 0 : 1;
    for (int i = 0; i < again; ++i) steady = equal(one.result, run(*stored)) && steady;
  }
  out.push_back(std::move(one));
  return steady;
}

Shown shown_by(const std::vector<CaseReplay>& cases) {
  if (std::ranges::any_of(cases, [](const CaseReplay& c) { return fails(c.result); })) return Shown::fails;
  const auto refused = [](const CaseReplay& c) { return c.result.verdict == Verdict::refused; };
  return std::ranges::any_of(cases, refused) ? Shown::refused : Shown::gone;
}

// The verdict of the cases that still fail. If none does, it is `different` if a case fails in another way.
Verdict verdict_of(const std::vector<CaseReplay>& cases, Shown shown) {
  if (shown == Shown::refused || cases.empty()) return Verdict::refused;
  Verdict verdict = shown == Shown::fails ? Verdict::same : Verdict::passes;
  for (const CaseReplay& one : cases)
    if (fails(one.result) == (shown == Shown::fails))
      verdict = shown == Shown::fails ? std::max(verdict, one.result.verdict) : std::min(verdict, one.result.verdict);
  return verdict;
}

constexpr std::array kOrder = {BucketState::regressed, BucketState::fresh, BucketState::quarantined,
                               BucketState::open,      BucketState::flaky, BucketState::invalid,
                               BucketState::fixed};

std::size_t rank_of(BucketState state) {
  return static_cast<std::size_t>(std::ranges::find(kOrder, state) - kOrder.begin());
}

}  // namespace

BucketReplay replay_bucket(const Corpus& corpus, const Bucket& bucket, const RunCase& run) {
  BucketReplay result{bucket, Shown::refused, {}, Verdict::refused};
  bool steady = true;
  for (const Corpus::Stored& stored : corpus.cases_of(result.bucket))
    steady = replay_case(bucket, stored, run, result.cases) && steady;
  result.shown = result.cases.empty() ? Shown::refused : shown_by(result.cases);
  result.verdict = verdict_of(result.cases, result.shown);
  if (!steady) result.shown = Shown::unsteady;
  return result;
}

std::vector<Bucket> replay_order(std::vector<Bucket> buckets) {
  std::ranges::sort(buckets, {}, [](const Bucket& b) { return std::pair(rank_of(b.state), folder_name(b)); });
  return buckets;
}

std::vector<Bucket> replay_order_of_day(std::vector<Bucket> buckets, const std::string& day) {
  std::ranges::sort(buckets, {}, [&](const Bucket& bucket) { return content_id(day + folder_name(bucket)); });
  std::array<std::vector<Bucket>, kOrder.size()> of_state;
  for (Bucket& bucket : buckets) of_state[rank_of(bucket.state)].push_back(std::move(bucket));
  std::vector<Bucket> ordered;
  for (std::size_t turn = 0; ordered.size() < buckets.size(); ++turn)
    for (std::vector<Bucket>& queue : of_state)
      if (turn < queue.size()) ordered.push_back(std::move(queue[turn]));
  return ordered;
}

bool may_skip(const Bucket& bucket) { return bucket.state != BucketState::quarantined; }

}  // namespace contort
