// Verdicts of replay on cases that fail, fail otherwise, or do not fail any more.
#include "corpus/ending_case.h"
#include "corpus/replay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/corpus/sample_cases.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

Replay replayed(const Case& stored, const Library& library = stock_library()) {
  BuiltInGenerator generator(library);
  Evaluator evaluator(generator);
  return replay(stored, evaluator);
}

TEST(Replay, AnUntouchedCaseIsTheSame) {
  const Case stored = elbow_case();
  const Replay result = replayed(stored);
  EXPECT_EQ(result.verdict, Verdict::same);
  EXPECT_EQ(result.first_difference, -1);
  EXPECT_FALSE(result.character_changed);
  EXPECT_EQ(result.now, stored.expect);
}

TEST(Replay, IsTheSameAfterAnotherCaseWasReplayed) {
  const Case stored = elbow_case();
  Evaluator evaluator(stock_generator());
  replay(elbow_case(300, 20), evaluator);
  EXPECT_EQ(replay(stored, evaluator).verdict, Verdict::same);
}

TEST(Replay, AnotherMotionWithTheSameFailureIsTheSameFamily) {
  const Case slow = elbow_case(190, 60);
  Case stored = elbow_case(190, 50);
  stored.expect = slow.expect;
  const Replay result = replayed(stored);
  EXPECT_EQ(result.verdict, Verdict::same_family);
  EXPECT_EQ(result.now, elbow_case(190, 50).expect);
  const auto motion = [](const Case& c) { return generate(*build_stage(c.spec, stock_library())); };
  // Frame 0 is at rest in both, but motions of different lengths differ in their hashes only, not in their traces.
  EXPECT_EQ(first_difference(motion(slow), motion(stored)), 1);
  EXPECT_EQ(result.first_difference, 1);
}

TEST(Replay, TheFirstFrameThatDiffersIsNamed) {
  const auto two_steps = [](double second_deg) {
    Spec spec = bent_elbow(190, 60);
    ActionUse later = pose_use("arm_right", {{"elbow_deg", second_deg}}, 20);
    later.start_frame = 30;
    spec.sequences[0].clips[0].actions.push_back(later);
    return failing_case(spec, "joint_range", kElbow);
  };
  Case stored = two_steps(60);
  stored.expect = two_steps(70).expect;
  const Replay result = replayed(stored);
  EXPECT_EQ(result.verdict, Verdict::same_family);
  EXPECT_EQ(result.first_difference, 31);  // at frame 30 the second action is still at its start
}

TEST(Replay, AMotionThatEndsEarlierDiffersWhereItEnds) {
  Case stored = elbow_case();
  stored.expect.trace.resize(stored.expect.trace.size() - 40);
  stored.expect.motion_hash = "0000000000000000";
  EXPECT_EQ(replayed(stored).first_difference, 51);
}

TEST(Replay, AHandWrittenCaseWithoutATraceHasNoFrameThatDiffers) {
  Case stored = elbow_case();
  stored.expect.trace.clear();
  const Replay result = replayed(stored);
  EXPECT_EQ(result.verdict, Verdict::same);
  EXPECT_EQ(result.first_difference, -1);
}

TEST(Replay, OtherLimitsAreAChangedCharacterAndTheSameFamily) {
  Library library = stock_library();
  library.parts.at("human_arm").joints[1].high_deg = 160;
  const Replay result = replayed(elbow_case(), library);
  EXPECT_EQ(result.verdict, Verdict::same_family);
  EXPECT_TRUE(result.character_changed);
  EXPECT_EQ(result.first_difference, -1) << "limits do not move the motion";
  EXPECT_NEAR(result.now.worst_margin, -30 * kRadPerDeg, 1e-12);
}

TEST(Replay, WiderLimitsThanTheMotionNeedsPass) {
  Library library = stock_library();
  library.parts.at("human_arm").joints[1].high_deg = 200;
  const Replay result = replayed(elbow_case(152), library);
  EXPECT_EQ(result.verdict, Verdict::passes) << result.now.subject;
  EXPECT_TRUE(result.character_changed);
}

TEST(Replay, EveryNumberOfTheFindingCounts) {
  const Case stored = elbow_case();
  const auto verdict_with = [&](auto change) {
    Case changed = stored;
    change(changed.expect);
    return replayed(changed).verdict;
  };
  EXPECT_EQ(verdict_with([](Expectation& e) { ++e.first_frame; }), Verdict::same_family);
  EXPECT_EQ(verdict_with([](Expectation& e) { --e.worst_frame; }), Verdict::same_family);
  EXPECT_EQ(verdict_with([](Expectation& e) { --e.last_frame; }), Verdict::same_family);
  EXPECT_EQ(verdict_with([](Expectation& e) { e.depth *= 1.0 + 1e-15; }), Verdict::same_family);
  EXPECT_EQ(verdict_with([](Expectation& e) { e.motion_hash = "0000000000000000"; }), Verdict::same_family);
}

TEST(Replay, AnotherFailureIsDifferent) {
  Case stored = elbow_case();
  stored.expect.subject = "arm_right/elbow max";
  const Replay result = replayed(stored);
  EXPECT_EQ(result.verdict, Verdict::different);
  EXPECT_EQ(result.now.subject, kElbow);
}

TEST(Replay, AMotionWithoutFindingsPasses) {
  Case stored = elbow_case();
  stored.spec = bent_elbow(100);
  const Replay result = replayed(stored);
  EXPECT_EQ(result.verdict, Verdict::passes);
  EXPECT_GT(result.first_difference, 0);
  EXPECT_FALSE(result.character_changed);
}

TEST(Replay, ASpecThatDoesNotBuildIsRefusedWithItsIssue) {
  Case stored = elbow_case();
  stored.spec.sequences[0].clips[0].actions[0].slot = "tail";
  const Replay result = replayed(stored);
  EXPECT_EQ(result.verdict, Verdict::refused);
  EXPECT_EQ(result.issue.code, "spec.unknown_slot");
  stored = elbow_case();
  stored.spec.character.name = "nobody";
  EXPECT_EQ(replayed(stored).issue.code, "character.unknown_character");
}

TEST(Replay, AFailureThatIsNoNumberIsStoredReadAndReplayedAsTheSame) {
  const Library nowhere = library_with_nowhere();
  const Result<Stage> stage = build_stage(bent_elbow(100), nowhere);
  ASSERT_TRUE(stage);
  const Evaluation evaluation = StageEvaluator().run(*stage);
  ASSERT_FALSE(evaluation.findings.empty());
  const Finding& finding = evaluation.findings.front();
  ASSERT_TRUE(std::isnan(finding.worst_margin));
  const Case stored = failing_case(bent_elbow(100), finding.check, finding.subject, nowhere);
  EXPECT_EQ(stored.expect.depth, 0.0);
  const Result<Case> read = parse_case(print_case(stored));
  ASSERT_TRUE(read) << to_line(read.issue());
  EXPECT_EQ(replayed(*read, nowhere).verdict, Verdict::same);
  EXPECT_EQ(replayed(*read).verdict, Verdict::passes);
}

Case ended_case(Ending::Kind kind, const std::string& signal = "") {
  return ending_case(bent_elbow(100), {kind, signal, ""});
}

Verdict verdict_of_ending(const Case& stored, const std::function<Replay()>& work, int seconds = 20) {
  Isolation isolation;
  isolation.seconds = seconds;
  isolation.silent = true;
  return replay_ending(stored, work, isolation).verdict;
}

TEST(ReplayOfAnEnding, TheSameEndIsTheSameAndAnotherOneIsDifferent) {
  const auto abort = []() -> Replay { std::abort(); };
  const auto hang = []() -> Replay {
    for (;;) ::pause();
  };
  EXPECT_EQ(verdict_of_ending(ended_case(Ending::Kind::crash, "SIGABRT"), abort), Verdict::same);
  EXPECT_EQ(verdict_of_ending(ended_case(Ending::Kind::crash, "SIGSEGV"), abort), Verdict::different);
  EXPECT_EQ(verdict_of_ending(ended_case(Ending::Kind::timeout), abort), Verdict::different);
  EXPECT_EQ(verdict_of_ending(ended_case(Ending::Kind::timeout), hang, 1), Verdict::same);
}

TEST(ReplayOfAnEnding, WhatFinishesNowIsReplayedAsUsual) {
  Case crashed = ended_case(Ending::Kind::crash, "SIGSEGV");
  EXPECT_EQ(replayed(crashed).verdict, Verdict::passes);
  EXPECT_FALSE(replayed(crashed).character_changed) << "nobody knows what it was";
  crashed.spec = bent_elbow(190);
  EXPECT_EQ(replayed(crashed).verdict, Verdict::different);
  EXPECT_EQ(replayed(crashed).now.subject, kElbow);
  crashed.spec.character.name = "nobody";
  EXPECT_EQ(replayed(crashed).verdict, Verdict::refused);
}

TEST(Replay, VerdictsHaveDifferentNames) {
  std::vector<std::string_view> names;
  for (const Verdict v : {Verdict::same, Verdict::same_family, Verdict::different, Verdict::passes, Verdict::refused}) {
    EXPECT_FALSE(verdict_name(v).empty());
    EXPECT_EQ(std::count(names.begin(), names.end(), verdict_name(v)), 0);
    names.push_back(verdict_name(v));
  }
}

}  // namespace

}  // namespace contort
