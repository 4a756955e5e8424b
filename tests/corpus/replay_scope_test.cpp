// Storage levels: the whole, a sequence, a clip, a part.
#include "corpus/replay_scope.h"

#include <gtest/gtest.h>

#include <set>

#include "corpus/evaluator.h"
#include "generator/built_in.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::coord;
using fixtures::elbow;
using fixtures::human;
using fixtures::sequence;
using fixtures::use;

Spec two_sequences() {
  Spec spec;
  SequenceDesc second = sequence({elbow(0, 10, 60)});
  second.clips.push_back(second.clips[0]);
  second.clips[1].start_frame = 20;
  second.clips[1].actions = {elbow(0, 15, 30), use("pose", "arm_right", 0, 15, {{"elbow_deg", 70.0}})};
  spec.sequences = {sequence({elbow(0, 30, 90)}), second};
  return spec;
}

Result<Execution> run(const std::string& text) {
  const Result<ReplayScope> scope = parse_scope(text);
  if (!scope) return scope.issue();
  BuiltInGenerator generator;
  return execute(generator, scoped(two_sequences(), *scope));
}

Motion play(const std::string& scope) {
  const Result<Execution> execution = run(scope);
  EXPECT_TRUE(execution.ok()) << scope << (execution.ok() ? "" : to_line(execution.issue()));
  return execution->motion;
}

std::vector<double> posture(const Motion& motion, int frame) {
  const std::span<const double> row = motion.row(frame);
  return {row.begin(), row.end()};
}

std::string refusal(const std::string& scope) {
  const Result<Execution> execution = run(scope);
  return execution ? "" : execution.issue().code;
}

// The frames of a level equal those of the whole motion, because earlier sequences left the same state.
TEST(ReplayScopes, ASequenceBeginsFromTheStateThatTheOneBeforeHasLeft) {
  const Motion whole = generate(*build_stage(two_sequences(), stock_library()));
  const Motion second = play("sequence:2");
  EXPECT_EQ(second.first_frame, 30);
  ASSERT_EQ(second.frame_count, whole.frame_count);
  for (int f = 0; f < whole.frame_count; ++f) EXPECT_EQ(posture(second, f), posture(whole, f)) << f;
}

TEST(ReplayScopes, ASequenceEndsWithoutThoseBehindIt) {
  const Motion first = play("sequence:1");
  EXPECT_EQ(first.first_frame, 0);
  EXPECT_EQ(first.frame_count, 31);
}

TEST(ReplayScopes, AClipBeginsFromTheStateThatTheOneBeforeHasLeft) {
  const Motion whole = generate(*build_stage(two_sequences(), stock_library()));
  const Motion clip = play("clip:2/2");
  EXPECT_EQ(clip.first_frame, 50);
  ASSERT_EQ(clip.frame_count, 66);
  EXPECT_EQ(coord(clip, 50, human(), "arm_left/elbow"), 60 * kRadPerDeg);
  EXPECT_EQ(coord(clip, 65, human(), "arm_left/elbow"), 30 * kRadPerDeg);
  for (int f = 50; f <= 65; ++f) EXPECT_EQ(posture(clip, f), posture(whole, f)) << f;
}

// The elbow is on its way from 0 to 90 when a second clip begins on the other arm.
TEST(ReplayScopes, AClipCutsThoseThatGoOnBesideIt) {
  Spec spec;
  SequenceDesc both = sequence({elbow(0, 40, 90)});
  both.clips.push_back(both.clips[0]);
  both.clips[1].start_frame = 20;
  both.clips[1].actions = {use("pose", "arm_right", 0, 30, {{"elbow_deg", 70.0}})};
  spec.sequences = {both};
  BuiltInGenerator generator;
  const Result<Execution> execution = execute(generator, scoped(spec, *parse_scope("clip:1/2")));
  ASSERT_TRUE(execution.ok());
  const Motion& clip = execution->motion;
  EXPECT_EQ(clip.first_frame, 20);
  EXPECT_EQ(clip.frame_count, 51);
  EXPECT_NEAR(coord(clip, 20, human(), "arm_left/elbow"), 45 * kRadPerDeg, 1e-9);
  EXPECT_EQ(coord(clip, 50, human(), "arm_left/elbow"), coord(clip, 20, human(), "arm_left/elbow"));
  EXPECT_EQ(coord(clip, 50, human(), "arm_right/elbow"), 70 * kRadPerDeg);
}

// The queue starts interrupts at a frame itself; other events are reported to it.
TEST(ReplayScopes, ALevelIsNotInterrupted) {
  for (const Event event : {Event::frame, Event::near_obstacle}) {
    Spec spec = two_sequences();
    spec.environment.obstacles = {{"ball", Sphere{Vec3(0.0, 1.0, 2.0), 0.1}}};
    InterruptDesc interrupt;
    interrupt.when.event = event, interrupt.when.frame = 12, interrupt.when.distance_m = 5.0;
    interrupt.sequence = sequence({elbow(0, 10, 10)});
    spec.interrupts = {interrupt};
    BuiltInGenerator generator;
    const Result<Execution> level = execute(generator, scoped(spec, *parse_scope("sequence:1")));
    ASSERT_TRUE(level.ok()) << to_line(level.issue());
    EXPECT_EQ(level->motion.frame_count, 31) << event_name(event);
    EXPECT_EQ(coord(level->motion, 30, human(), "arm_left/elbow"), 90 * kRadPerDeg) << event_name(event);
  }
}

TEST(ReplayScopes, TheSequenceOfAnInterruptBeginsWhereItFires) {
  Spec spec = two_sequences();
  InterruptDesc interrupt;
  interrupt.when.event = Event::frame, interrupt.when.frame = 12;
  interrupt.sequence = sequence({elbow(0, 10, 10)});
  spec.interrupts = {interrupt};
  BuiltInGenerator generator;
  const Result<Execution> whole = execute(generator, spec);
  const Result<Execution> level = execute(generator, scoped(spec, *parse_scope("sequence:3")));
  ASSERT_TRUE(level.ok());
  const Motion& motion = level->motion;
  EXPECT_GE(motion.first_frame, 12);
  EXPECT_LE(motion.first_frame, 13);
  EXPECT_EQ(motion.frame_count, motion.first_frame + 11);
  for (int f = 0; f < motion.frame_count - 1; ++f) EXPECT_EQ(posture(motion, f), posture(whole->motion, f)) << f;
}

// A jump at the seam is found when the second level is played alone, and earlier faults are not.
TEST(ReplayScopes, AJumpAtTheSeamIsFoundAndWhatCameBeforeIsNot) {
  Spec spec;
  ActionUse wild = elbow(0, 30, 90);
  wild.params["elbow_deg"] = 200.0;  // out of range
  ActionUse jump = elbow(0, 0, 0);
  jump.blend_in_frames = 0;
  spec.sequences = {sequence({wild}), sequence({elbow(0, 30, 100)}), sequence({jump, elbow(1, 30, 0)})};
  BuiltInGenerator generator;
  Evaluator evaluator(generator, {});
  const auto checks_of = [&](const char* scope) {
    std::set<std::string> checks;
    const Result<Evaluation> run = evaluator.run(scoped(spec, *parse_scope(scope)));
    EXPECT_TRUE(run.ok());
    for (const Finding& finding : run->findings) checks.insert(finding.check);
    return checks;
  };
  EXPECT_TRUE(checks_of("sequence:1").contains("joint_range"));
  EXPECT_FALSE(checks_of("sequence:3").contains("joint_range"));
  EXPECT_TRUE(checks_of("sequence:3").contains("pop"));
}

TEST(ReplayScopes, APartMovesAsInTheWholeAndAllElseStays) {
  const Motion whole = generate(*build_stage(two_sequences(), stock_library()));
  const Motion right = play("part:arm_right");
  ASSERT_EQ(right.frame_count, whole.frame_count);
  for (int f = 0; f < whole.frame_count; ++f) {
    EXPECT_EQ(coord(right, f, human(), "arm_right/elbow"), coord(whole, f, human(), "arm_right/elbow"));
    EXPECT_EQ(coord(right, f, human(), "arm_left/elbow"), 0.0);
  }
}

TEST(ReplayScopes, WhatIsNotThereIsRefused) {
  for (const char* bad :
       {"", "sequence", "sequence:", "sequence:0", "sequence:1/1", "clip:1", "clip:1/x", "part:", "whole:1"})
    EXPECT_EQ(refusal(bad), "level.bad_name") << bad;
  EXPECT_EQ(refusal("sequence:3"), "spec.no_sequence");
  EXPECT_EQ(refusal("clip:1/2"), "spec.no_clip");
  EXPECT_EQ(refusal("part:tail"), "spec.unknown_slot");
}

}  // namespace
}  // namespace contort
