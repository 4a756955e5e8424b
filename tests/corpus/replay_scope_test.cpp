// Storage levels: the whole, a sequence, a clip, a part.
#include "corpus/replay_scope.h"

#include <gtest/gtest.h>

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
  const Result<Spec> spec = scoped(two_sequences(), *scope);
  if (!spec) return spec.issue();
  BuiltInGenerator generator;
  return execute(generator, *spec);
}

Motion play(const std::string& scope) {
  const Result<Execution> execution = run(scope);
  EXPECT_TRUE(execution.ok()) << scope << (execution.ok() ? "" : to_line(execution.issue()));
  return execution->motion;
}

std::string refusal(const std::string& scope) {
  const Result<Execution> execution = run(scope);
  return execution ? "" : execution.issue().code;
}

TEST(ReplayScopes, ASequenceAndAClipBeginAtFrameZero) {
  const Motion second = play("sequence:2");
  EXPECT_EQ(second.frame_count, 36);
  EXPECT_EQ(coord(second, 10, human(), "arm_left/elbow"), 60 * kRadPerDeg);
  const Motion clip = play("clip:2/2");
  EXPECT_EQ(clip.frame_count, 16);
  EXPECT_EQ(coord(clip, 15, human(), "arm_left/elbow"), 30 * kRadPerDeg);
  EXPECT_EQ(coord(clip, 15, human(), "arm_right/elbow"), 70 * kRadPerDeg);
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
  EXPECT_EQ(refusal("sequence:3"), "level.no_sequence");
  EXPECT_EQ(refusal("clip:1/2"), "level.no_clip");
  EXPECT_EQ(refusal("part:tail"), "spec.unknown_slot");
}

}  // namespace
}  // namespace contort
