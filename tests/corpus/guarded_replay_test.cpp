// Replays in a worker: a generator that ends its process on one case does not affect other cases.
#include "corpus/ending_case.h"
#include "corpus/guarded_replay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "tests/corpus/sample_cases.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

constexpr double kCrashes_deg = 171, kHangs_deg = 172;

Case bent_elbow_case(double degrees) { return failing_case(bent_elbow(degrees), "joint_range", kElbow); }

double elbow_of(const Case& stored) {
  return std::get<double>(stored.spec.sequences[0].clips[0].actions[0].params.at("elbow_deg"));
}

// The real one, but for two angles.
Replay faulty(const Case& stored) {
  if (elbow_of(stored) == kCrashes_deg) std::abort();
  while (elbow_of(stored) == kHangs_deg) ::pause();
  Evaluator evaluator(stock_generator());
  return replay(stored, evaluator);
}

TEST(GuardedReplay, ShowsWhatAReplayHereShows) {
  GuardedReplay guarded(faulty, {});
  Evaluator evaluator(stock_generator());
  Case refused = bent_elbow_case(170), passes = bent_elbow_case(170), other = bent_elbow_case(170);
  refused.spec.character.name = "nobody";
  passes.spec = bent_elbow(20);
  other.spec = bent_elbow(165);
  other.expect.trace[0] = other.expect.trace[0] == '0' ? '1' : '0';
  for (const Case& stored : {bent_elbow_case(170), refused, passes, other}) {
    const Replay here = replay(stored, evaluator), there = guarded(stored);
    EXPECT_EQ(there.verdict, here.verdict);
    EXPECT_EQ(there.first_difference, here.first_difference);
    EXPECT_EQ(there.character_changed, here.character_changed);
    EXPECT_EQ(there.issue, here.issue);
    EXPECT_EQ(there.now.motion_hash, here.now.motion_hash);
    EXPECT_TRUE(here.verdict == Verdict::passes || there.now == here.now);
  }
  EXPECT_EQ(guarded(bent_elbow_case(170)).verdict, Verdict::same);
  EXPECT_EQ(guarded(refused).verdict, Verdict::refused);
  EXPECT_EQ(guarded(passes).verdict, Verdict::passes);
}

TEST(GuardedReplay, WhatCrashesOrHangsIsDifferentAndTheNextCaseIsReplayed) {
  GuardedReplay guarded(faulty, {0.5, std::int64_t{4} << 30});
  const Replay crashed = guarded(bent_elbow_case(kCrashes_deg));
  EXPECT_EQ(crashed.verdict, Verdict::different);
  EXPECT_EQ(crashed.now.check + "|" + crashed.now.subject, "crash|SIGABRT");
  EXPECT_EQ(guarded(bent_elbow_case(170)).verdict, Verdict::same);
  const Replay hung = guarded(bent_elbow_case(kHangs_deg));
  EXPECT_EQ(hung.verdict, Verdict::different);
  EXPECT_EQ(hung.now.check, "timeout");
  EXPECT_EQ(guarded(bent_elbow_case(170)).verdict, Verdict::same);
}

// The worker may take as long as the stored limit, whatever its own limit is.
TEST(GuardedReplay, AStoredTimeoutIsGivenTheTimeInWhichItDidNotEnd) {
  Isolation two_seconds;
  two_seconds.seconds = 2;
  const Case stored = ending_case(bent_elbow(20), {Ending::Kind::timeout, {}, {}}, two_seconds);
  EXPECT_EQ(stored.expect.limit_s, 2);
  const auto takes_1_s = [](const Case& c) {
    return replay_ending(c, [] { return ::usleep(1'200'000), Replay{Verdict::passes, -1, false, {}, {}}; }, {});
  };
  GuardedReplay guarded(takes_1_s, {1.0, std::int64_t{4} << 30});
  EXPECT_EQ(guarded(stored).verdict, Verdict::passes);
  Case in_one = stored;
  in_one.expect.limit_s = 1;
  EXPECT_EQ(guarded(in_one).verdict, Verdict::same);
}

}  // namespace
}  // namespace contort
