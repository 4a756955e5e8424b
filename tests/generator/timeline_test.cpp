// The layout of clips and sequences: stretching, speed, the queue.
#include "generator/timeline/timeline.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/core/random_space.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::elbow;
using fixtures::human;
using fixtures::lattice_number;
using fixtures::sequence;

Timeline timeline_of(const std::vector<SequenceDesc>& sequences) {
  const Result<Timeline> timeline = lay_out({sequences, {}, human()});
  if (!timeline) ADD_FAILURE() << to_line(timeline.issue());
  return timeline ? *timeline : Timeline{};
}

TEST(Timeline, NaturalLengthsAreTheEndOfTheLastAction) {
  SequenceDesc two_clips = sequence({elbow(0, 30, 10), elbow(40, 20, 20)});
  two_clips.clips.push_back(two_clips.clips[0]);
  two_clips.clips[1].start_frame = 15;
  const Timeline timeline = timeline_of({two_clips});
  EXPECT_EQ(timeline.frame_count, 75);
  EXPECT_EQ(timeline.actions[3].start, 55.0);
  EXPECT_EQ(timeline.actions[3].end, 75.0);
  EXPECT_EQ(timeline_of({}).frame_count, 0);
  EXPECT_EQ(timeline_of({SequenceDesc{}, sequence({elbow(0, 7, 0)})}).frame_count, 7);
}

TEST(Timeline, SpeedTwoHalvesTheLengthOfAClip) {
  SequenceDesc fast = sequence({elbow(10, 30, 10)});
  fast.clips[0].start_frame = 8;
  fast.clips[0].speed = 2;
  const Timeline timeline = timeline_of({fast});
  EXPECT_EQ(timeline.frame_count, 8 + 20);
  EXPECT_EQ(timeline.actions[0].start, 8 + 5.0);
  EXPECT_EQ(timeline.actions[0].end, 8 + 20.0);
}

// Content of a clip that is stretched to twice its length comes at twice the time from its start.
RC_GTEST_PROP(Timeline, StretchedClipsPlayTheSameContentAtAnotherPace, ()) {
  const int first = *rc::gen::inRange(0, 60);
  const int length = *rc::gen::inRange(1, 60);
  const int factor = *rc::gen::inRange(1, 9);
  SequenceDesc plain = sequence({elbow(first, length, 10)});
  SequenceDesc slow = plain;
  slow.clips[0].duration_frames = factor * (first + length);
  const PlannedAction a = timeline_of({plain}).actions[0];
  const PlannedAction b = timeline_of({slow}).actions[0];
  RC_ASSERT(b.start == factor * a.start);
  RC_ASSERT(b.end == factor * a.end);
  for (int frame = 0; frame <= first + length; ++frame)
    RC_ASSERT(std::fabs(progress(b, factor * frame) - progress(a, frame)) < 1e-12);
}

// 7 * (29.0 / 7) is more than 29: such a sequence once took a frame too many.
TEST(Timeline, StretchedLengthsAreExactly) {
  for (int natural = 1; natural <= 120; ++natural)
    for (int wanted = 1; wanted <= 120; ++wanted) {
      SequenceDesc clip_stretched = sequence({elbow(0, natural, 10)});
      clip_stretched.clips[0].duration_frames = wanted;
      SequenceDesc stretched = sequence({elbow(0, natural, 10)});
      stretched.duration_frames = wanted;
      const Timeline timeline = timeline_of({clip_stretched, stretched});
      ASSERT_EQ(timeline.frame_count, 2 * wanted) << natural << " to " << wanted;
      ASSERT_EQ(timeline.actions[0].last_frame, wanted) << natural << " to " << wanted;
      ASSERT_EQ(timeline.actions[1].first_frame, 0) << natural << " to " << wanted;
      ASSERT_EQ(timeline.actions[1].last_frame, wanted) << natural << " to " << wanted;
    }
}

RC_GTEST_PROP(Timeline, SequencesHaveWholeLengths, ()) {
  std::vector<SequenceDesc> sequences;
  for (int i = *rc::gen::inRange(1, 5); i > 0; --i) {
    sequences.push_back(sequence({elbow(*rc::gen::inRange(0, 9), *rc::gen::inRange(1, 40), 10)}));
    sequences.back().clips[0].speed = lattice_number(0.1, 10);
    sequences.back().duration_frames = *rc::gen::inRange(0, 50);
  }
  const Timeline timeline = timeline_of(sequences);
  int whole = 0;
  for (std::size_t s = 0; s < sequences.size(); ++s) {
    const PlannedAction& action = timeline.actions[s];
    RC_ASSERT(action.sequence == static_cast<int>(s));
    RC_ASSERT(action.start >= 0.0);
    RC_ASSERT(action.end > action.start);
    RC_ASSERT(timeline.sequences[s].length == static_cast<int>(std::ceil(action.end - 1e-6)));  // the only action
    whole += timeline.sequences[s].length;
  }
  RC_ASSERT(timeline.frame_count == whole);
}

RC_GTEST_PROP(Timeline, ProgressClimbsFromZeroToOne, ()) {
  PlannedAction action;
  action.start = lattice_number(0, 100);
  action.end = action.start + lattice_number(0.001, 100);
  action.speed = lattice_number(0.1, 10);
  double before = 0.0;
  for (int frame = 0; frame < 220; ++frame) {
    const double now = progress(action, frame);
    RC_ASSERT(now >= before);
    RC_ASSERT(now <= 1.0);
    if (frame <= action.start) RC_ASSERT(now == 0.0);
    if (frame >= action.end && action.speed >= 1.0) RC_ASSERT(now == 1.0);
    before = now;
  }
}

TEST(Timeline, ActionsWithoutLengthArriveOneFrameAfterTheirStart) {
  SequenceDesc tiny = sequence({elbow(0, 1, 10), elbow(36000, 36000, 20)});
  tiny.clips[0].duration_frames = 1, tiny.clips[0].speed = 10;  // 1.4e-6 of a frame
  const Timeline timeline = timeline_of({sequence({elbow(5, 0, 90)}), tiny});
  EXPECT_EQ(timeline.sequences[0].length, 6);
  for (const PlannedAction& action : timeline.actions) {
    EXPECT_GT(action.last_frame, action.start);
    EXPECT_LE(action.last_frame, timeline.sequences[static_cast<std::size_t>(action.sequence)].length);
    EXPECT_EQ(progress(action, action.last_frame), 1.0);
    EXPECT_EQ(progress(action, static_cast<int>(std::floor(action.start))), 0.0);
  }
}

TEST(Timeline, TenMinutesAreTheLimit) {
  EXPECT_TRUE(lay_out({{sequence({elbow(0, 36000, 0)})}, {}, human()}).ok());
  const Result<Timeline> longer = lay_out({{sequence({elbow(0, 36000, 0)}), sequence({elbow(0, 1, 0)})}, {}, human()});
  ASSERT_FALSE(longer.ok());
  EXPECT_EQ(longer.issue().code, "spec.too_long");
  EXPECT_EQ(longer.issue().pointer, "/sequences/1");
  Spec spec;
  spec.sequences = {sequence({elbow(0, 36000, 0)})};
  EXPECT_EQ(build_stage(spec, stock_library())->most_frames, 36001);
  spec.hold_frames = 1;
  EXPECT_EQ(build_stage(spec, stock_library()).issue().code, "spec.too_long");
  EXPECT_EQ(build_stage(spec, stock_library()).issue().pointer, "/hold_frames");
}

TEST(Timeline, EaseKeepsItsEnds) {
  EXPECT_EQ(ease(0.0), 0.0);
  EXPECT_EQ(ease(0.5), 0.5);
  EXPECT_EQ(ease(1.0), 1.0);
}

// Greatest slope measured: 1.8749999 at 0.5.
TEST(Timeline, EaseClimbsSmoothly) {
  const int n = 10000;
  double steepest = 0.0;
  for (int i = 0; i < n; ++i) {
    const double slope = (ease((i + 1.0) / n) - ease(static_cast<double>(i) / n)) * n;
    EXPECT_GE(slope, -1e-9);
    steepest = std::max(steepest, slope);
  }
  EXPECT_LE(steepest, 1.875);
  EXPECT_GT(steepest, 1.8749);
  EXPECT_LT(ease(1e-3), 1.1e-8);  // no speed or acceleration at the ends
  EXPECT_LT(1.0 - ease(1.0 - 1e-3), 1.1e-8);
}

}  // namespace
}  // namespace contort
