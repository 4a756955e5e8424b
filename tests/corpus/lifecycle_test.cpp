// The states of a bucket, as docs/reference/corpus.md has them.
#include "corpus/lifecycle.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "corpus/baseline.h"
#include "tests/checks/family_text.h"
#include "tests/corpus/temp_folder.h"

namespace contort {

namespace {

const std::string kToday = "2027-02-10";
const std::string kBefore = "2027-02-09";
const std::string kInAMonth = "2027-03-12";  // 30 days after today

Bucket in_state(BucketState state) {
  Bucket bucket;
  bucket.id = "0123456789ab";
  bucket.check = "joint_range";
  bucket.state = state;
  if (state == BucketState::quarantined) bucket.owner = "ana", bucket.reason = "soft stop", bucket.expires = kToday;
  if (state == BucketState::fixed) bucket.passed_in = {"a", "b"};
  return bucket;
}

Bucket after(Bucket bucket, const std::vector<Observation>& seen, const std::string& today = kToday) {
  for (const Observation& one : seen) bucket = next_state(bucket, one, today);
  return bucket;
}

// ---- drawing

Observation draw_observation() {
  return {static_cast<Shown>(*rc::gen::inRange(0, 4)), std::string(1, *rc::gen::element('a', 'b', 'c'))};
}

std::string draw_day() { return *rc::gen::element(kBefore, kToday, kInAMonth); }

// Applies one of all changes by people and replays to a bucket.
Bucket draw_step(const Bucket& bucket) {
  const int what = *rc::gen::inRange(0, 8);
  const Result<Bucket> done = what == 0   ? acknowledge(bucket, "ana", "12")
                              : what == 1 ? quarantine(bucket, "bo", "soft stop", kToday, kToday)
                              : what == 2 ? annotate(bucket, *rc::gen::element<std::string>("", "x", "y"))
                                          : Result<Bucket>(next_state(bucket, draw_observation(), draw_day()));
  return done ? *done : bucket;
}

Bucket draw_bucket() {
  Bucket bucket = in_state(BucketState::fresh);
  const int steps = *rc::gen::inRange(0, 12);
  for (int i = 0; i < steps; ++i) bucket = draw_step(bucket);
  return bucket;
}

// ---- invariants

RC_GTEST_PROP(Lifecycle, OnlyNewRegressedAndExpiredQuarantinesGate, ()) {
  const Bucket bucket = draw_bucket();
  const std::string today = draw_day();
  const bool expired = bucket.state == BucketState::quarantined && bucket.expires < today;
  RC_ASSERT(is_gating(bucket, today) ==
            (expired || bucket.state == BucketState::fresh || bucket.state == BucketState::regressed));
}

RC_GTEST_PROP(Lifecycle, WhatWasFixedAndFailsHasRegressedAndGatesWhoeverOwnsIt, ()) {
  Bucket bucket = draw_bucket();
  RC_PRE(bucket.state != BucketState::quarantined);
  bucket.state = BucketState::fixed;
  // Even where it was flaky or could not be built in between.
  const int detours = *rc::gen::inRange(0, 3);
  for (int i = 0; i < detours; ++i)
    bucket = next_state(bucket, {*rc::gen::element(Shown::refused, Shown::unsteady), "a"}, draw_day());
  for (int i = 0; i < kSteadyReplays; ++i) bucket = next_state(bucket, {Shown::fails, "a"}, draw_day());
  RC_ASSERT(bucket.state == BucketState::regressed);
  RC_ASSERT(is_gating(bucket, draw_day()));
}

RC_GTEST_PROP(Lifecycle, FixedNeedsTwoBuildsSinceTheLastFailure, ()) {
  Bucket bucket = in_state(BucketState::fresh);
  std::set<std::string> builds;
  for (int i = 0; i < 8; ++i) {
    const Observation seen{*rc::gen::element(Shown::fails, Shown::gone), std::string(1, *rc::gen::element('a', 'b'))};
    if (bucket.state == BucketState::fixed) break;
    if (seen.shown == Shown::fails) builds.clear();
    if (seen.shown == Shown::gone) builds.insert(seen.build);
    bucket = next_state(bucket, seen, kToday);
    RC_ASSERT((bucket.state == BucketState::fixed) == (builds.size() >= 2));
  }
}

RC_GTEST_PROP(Lifecycle, ChangesCountsWhatChangedAndNothingElse, ()) {
  const Bucket before = draw_bucket();
  const Bucket next = draw_step(before);
  Bucket same = next;
  same.changes = before.changes;
  RC_ASSERT(next.changes == before.changes + (same == before ? 0 : 1));
}

RC_GTEST_PROP(Lifecycle, QuarantinedStaysUntilItsLastDayWhateverIsSeen, ()) {
  const Bucket bucket = in_state(BucketState::quarantined);
  RC_ASSERT(next_state(bucket, draw_observation(), kToday).state == BucketState::quarantined);
  RC_ASSERT(next_state(bucket, draw_observation(), kInAMonth).state != BucketState::quarantined);
}

Bucket merged(Bucket a, const Bucket& b) {
  merge_state(a, b);
  return a;
}

RC_GTEST_PROP(Lifecycle, MergingIsCommutativeAssociativeAndIdempotent, ()) {
  const Bucket a = draw_bucket(), b = draw_bucket(), c = draw_bucket();
  RC_ASSERT(merged(a, a) == a);
  RC_ASSERT(merged(a, b) == merged(b, a));
  RC_ASSERT(merged(merged(a, b), c) == merged(a, merged(b, c)));
}

RC_GTEST_PROP(Lifecycle, ACopyThatWasChangedWinsOverTheOneItCameFrom, ()) {
  const Bucket old = draw_bucket();
  const Bucket next = draw_step(old);
  RC_ASSERT(merged(old, next) == next);
}

RC_GTEST_PROP(Lifecycle, FilesKeepAllOfIt, ()) {
  const TempFolder folder;
  Bucket bucket = draw_bucket();
  bucket.family = family("joint_range|human|arm_left/elbow max");
  RC_ASSERT(bool(write_bucket(folder.path(), bucket)));
  const Result<Bucket> read = read_bucket(folder.path());
  RC_ASSERT(bool(read));
  RC_ASSERT(*read == bucket);
}

// ---- the table

TEST(LifecycleTable, EveryStateAndEveryObservation) {
  struct Row {
    BucketState from, fails, gone, unsteady, refused;
  };
  using enum BucketState;
  const Row table[] = {
      {fresh, fresh, fresh, flaky, invalid},     {open, open, open, flaky, invalid},
      {fixed, regressed, fixed, flaky, invalid}, {regressed, regressed, regressed, flaky, invalid},
      {flaky, flaky, flaky, flaky, invalid},     {quarantined, quarantined, quarantined, quarantined, quarantined},
      {invalid, fresh, fresh, flaky, invalid}};
  for (const Row& row : table) {
    SCOPED_TRACE(state_name(row.from));
    const Bucket bucket = in_state(row.from);
    EXPECT_EQ(next_state(bucket, {Shown::fails, "c"}, kToday).state, row.fails);
    EXPECT_EQ(next_state(bucket, {Shown::gone, "c"}, kToday).state, row.gone);
    EXPECT_EQ(next_state(bucket, {Shown::unsteady, "c"}, kToday).state, row.unsteady);
    EXPECT_EQ(next_state(bucket, {Shown::refused, "c"}, kToday).state, row.refused);
  }
}

TEST(LifecycleTable, AnExpiredQuarantineGatesBeforeAndAfterItIsReplayed) {
  Bucket bucket = in_state(BucketState::quarantined);
  bucket.expires = kBefore;
  EXPECT_FALSE(is_gating(bucket, kBefore)) << "the last day is part of it";
  EXPECT_TRUE(is_gating(bucket, kToday));
  EXPECT_TRUE(is_gating(next_state(bucket, {Shown::fails, "a"}, kToday), kToday));
  EXPECT_TRUE(is_gating(next_state(bucket, {Shown::fails, "a"}, kToday), kBefore)) << "it does not come back";
}

TEST(LifecycleTable, OneBuildAloneFixesNothingHoweverOftenItIsReplayed) {
  const Bucket bucket = after(in_state(BucketState::open), std::vector<Observation>(9, {Shown::gone, "a"}));
  EXPECT_EQ(bucket.state, BucketState::open);
  EXPECT_EQ(bucket.changes, 1) << "replaying again changes nothing, and so no bytes";
  EXPECT_EQ(next_state(bucket, {Shown::gone, "b"}, kToday).state, BucketState::fixed);
}

TEST(LifecycleTable, AFlakyBucketIsAgainWhatItWasAfterTwentySteadyReplays) {
  Bucket bucket = next_state(in_state(BucketState::open), {Shown::unsteady, "a"}, kToday);
  EXPECT_FALSE(is_gating(bucket, kToday));
  bucket = after(bucket, std::vector<Observation>(kSteadyReplays - 1, {Shown::fails, "a"}));
  EXPECT_EQ(bucket.state, BucketState::flaky);
  EXPECT_EQ(next_state(bucket, {Shown::unsteady, "a"}, kToday).streak, 0);
  EXPECT_EQ(next_state(bucket, {Shown::fails, "a"}, kToday).state, BucketState::open);
}

TEST(LifecycleTable, AQuarantineThatAlwaysPassesIsStale) {
  Bucket bucket =
      after(in_state(BucketState::quarantined), std::vector<Observation>(kStalePasses - 1, {Shown::gone, "a"}));
  EXPECT_FALSE(is_stale(bucket));
  EXPECT_TRUE(is_stale(next_state(bucket, {Shown::gone, "a"}, kToday)));
  EXPECT_FALSE(is_stale(after(bucket, {{Shown::fails, "a"}, {Shown::gone, "a"}})));
}

TEST(LifecycleTable, AcknowledgingNeedsAnOwnerAndATicketAndSomethingThatFails) {
  EXPECT_EQ(acknowledge(in_state(BucketState::fresh), "", "12").issue().code, "bucket.no_owner");
  EXPECT_EQ(acknowledge(in_state(BucketState::fresh), "ana", "").issue().code, "bucket.no_ticket");
  EXPECT_EQ(acknowledge(in_state(BucketState::fixed), "ana", "12").issue().code, "bucket.is_fixed");
  for (const BucketState from : {BucketState::fresh, BucketState::regressed, BucketState::quarantined}) {
    const Result<Bucket> open = acknowledge(in_state(from), "ana", "12");
    ASSERT_TRUE(open);
    EXPECT_EQ(open->state, BucketState::open);
    EXPECT_EQ(open->ticket, "12");
    EXPECT_EQ(open->expires, "");
  }
}

TEST(LifecycleTable, AcknowledgingWhatIsSetAsideCountsOnceItIsBack) {
  const Result<Bucket> known = acknowledge(in_state(BucketState::invalid), "ana", "12");
  ASSERT_TRUE(known);
  EXPECT_EQ(known->state, BucketState::invalid);
  EXPECT_EQ(next_state(*known, {Shown::fails, "a"}, kToday).state, BucketState::open);
}

TEST(LifecycleTable, AQuarantineLastsThirtyDaysAtMost) {
  const auto code = [](const std::string& expires) {
    const Result<Bucket> done = quarantine(in_state(BucketState::fresh), "ana", "soft stop", expires, kToday);
    return done ? "" : done.issue().code;
  };
  EXPECT_EQ(code(kToday), "");
  EXPECT_EQ(code(kInAMonth), "");
  EXPECT_EQ(code("2027-03-13"), "bucket.too_long");
  EXPECT_EQ(code(kBefore), "bucket.too_long");
  EXPECT_EQ(code("2027-02-29"), "bucket.no_day");
  EXPECT_EQ(code("soon"), "bucket.no_day");
  EXPECT_EQ(quarantine(in_state(BucketState::open), "", "x", kToday, kToday).issue().code, "bucket.no_owner");
  EXPECT_EQ(quarantine(in_state(BucketState::open), "ana", "", kToday, kToday).issue().code, "bucket.no_reason");
  EXPECT_EQ(quarantine(in_state(BucketState::fixed), "ana", "x", kToday, kToday).issue().code, "bucket.is_fixed");
}

TEST(LifecycleTable, WhatTheBaselineHasDoesNotGate) {
  const Bucket bucket = in_state(BucketState::fresh);
  EXPECT_TRUE(is_gating(bucket, kToday, {}, {}));
  EXPECT_TRUE(is_gating(bucket, kToday, {{"ffffffffffff"}, {bucket.family}}, {}));
  EXPECT_FALSE(is_gating(bucket, kToday, {{bucket.id}, {}}, {}));
}

Family pop_of(std::string_view subject) { return {"pop", "human", std::string(subject)}; }

// A failure that waits to be shrunk is known only by its family.
TEST(LifecycleTable, AFamilyIsKnownInTheBaselineOrByABucketThatDoesNotGate) {
  std::vector<Bucket> buckets;
  for (const BucketState state : {BucketState::fresh, BucketState::open, BucketState::fixed, BucketState::regressed}) {
    buckets.push_back(in_state(state));
    buckets.back().family = pop_of(state_name(state));
    buckets.back().id = state_name(state);
  }
  EXPECT_EQ(known_families(buckets, kToday, {}, {}), std::set<Family>{pop_of("open")});
  const std::set<Family> with_baseline = {pop_of("new"), pop_of("open"), pop_of("other")};
  EXPECT_EQ(known_families(buckets, kToday, {{"new"}, {pop_of("other")}}, {}), with_baseline);
}

// The output of a replay by the other branch's contort: failures that it lists are known.
TEST(LifecycleTable, ABaselineMayBeAReplayByTheOtherBranch) {
  const TempFolder folder;
  spill(folder / "replay.json", R"([{"bucket": "pop-a", "family": "pop|x|y", "verdict": "same"},
    {"bucket": "joint_range-b", "family": "joint_range|x|y", "verdict": "same family"},
    {"bucket": "pop-c", "family": "pop|x|z", "verdict": "passes"},
    {"bucket": "pop-d", "family": "pop|x|w", "verdict": "different"}])");
  const Result<Baseline> known = read_baseline(folder / "replay.json");
  ASSERT_TRUE(known) << to_line(known.issue());
  EXPECT_EQ(*known, (Baseline{{"a", "b"}, {family("joint_range|x|y"), family("pop|x|y")}}));
}

TEST(LifecycleTable, ABaselineIsRefusedWhereItIsNone) {
  const TempFolder folder;
  const std::map<std::string, std::string> bad = {{"{}", "baseline.no_list"},
                                                  {"[{}]", "baseline.no_id"},
                                                  {"[{\"id\": 3}]", "baseline.no_id"},
                                                  {"[", "json.syntax"}};
  for (const auto& [text, code] : bad) {
    spill(folder / "list.json", text);
    const Result<Baseline> known = read_baseline(folder / "list.json");
    ASSERT_FALSE(known) << text;
    EXPECT_EQ(known.issue().code, code) << text;
  }
  EXPECT_EQ(read_baseline(folder.path()).issue().code, "corpus.not_found");
  EXPECT_EQ(read_baseline(folder / "missing").issue().code, "file.unreadable");
  spill(folder / "list.json", R"([{"id": "a", "state": "open", "family": "pop|x|y"}, {"id": "b", "state": "fixed"}, {"id": "c"}])");
  const Result<Baseline> known = read_baseline(folder / "list.json");
  ASSERT_TRUE(known);
  EXPECT_EQ(*known, (Baseline{{"a", "c"}, {family("pop|x|y")}})) << "what is fixed there is no failure that it has";
}

}  // namespace

}  // namespace contort
