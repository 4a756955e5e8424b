// Storage levels: the whole, a sequence, a clip, a part.
#include "generator/level.h"

#include <gtest/gtest.h>

#include "generator/generate.h"
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

Motion play(const std::string& level) {
  const Result<Level> parsed = parse_level(level);
  EXPECT_TRUE(parsed.ok()) << level;
  const Result<Stage> stage = build_stage_at(two_sequences(), stock_library(), *parsed);
  EXPECT_TRUE(stage.ok()) << (stage.ok() ? "" : to_line(stage.issue()));
  return generate(*stage);
}

std::string refusal(const std::string& level) {
  const Result<Level> parsed = parse_level(level);
  if (!parsed) return parsed.issue().code;
  const Result<Stage> stage = build_stage_at(two_sequences(), stock_library(), *parsed);
  return stage ? "" : stage.issue().code;
}

TEST(Levels, ASequenceAndAClipBeginAtFrameZero) {
  const Motion second = play("sequence:2");
  EXPECT_EQ(second.frame_count, 36);
  EXPECT_EQ(coord(second, 10, human(), "arm_left/elbow"), 60 * kRadPerDeg);
  const Motion clip = play("clip:2/2");
  EXPECT_EQ(clip.frame_count, 16);
  EXPECT_EQ(coord(clip, 15, human(), "arm_left/elbow"), 30 * kRadPerDeg);
  EXPECT_EQ(coord(clip, 15, human(), "arm_right/elbow"), 70 * kRadPerDeg);
}

TEST(Levels, APartMovesAsInTheWholeAndAllElseStays) {
  const Motion whole = generate(*build_stage(two_sequences(), stock_library()));
  const Motion right = play("part:arm_right");
  ASSERT_EQ(right.frame_count, whole.frame_count);
  for (int f = 0; f < whole.frame_count; ++f) {
    EXPECT_EQ(coord(right, f, human(), "arm_right/elbow"), coord(whole, f, human(), "arm_right/elbow"));
    EXPECT_EQ(coord(right, f, human(), "arm_left/elbow"), 0.0);
  }
}

TEST(Levels, WhatIsNotThereIsRefused) {
  for (const char* bad :
       {"", "sequence", "sequence:", "sequence:0", "sequence:1/1", "clip:1", "clip:1/x", "part:", "whole:1"})
    EXPECT_EQ(refusal(bad), "level.bad_name") << bad;
  EXPECT_EQ(refusal("sequence:3"), "level.no_sequence");
  EXPECT_EQ(refusal("clip:1/2"), "level.no_clip");
  EXPECT_EQ(refusal("part:tail"), "level.no_part");
}

}  // namespace
}  // namespace contort
