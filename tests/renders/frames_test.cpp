#include "renders/frames.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace contort {
namespace {

using Frames = std::vector<int>;

bool has(const Frames& frames, int frame) { return std::find(frames.begin(), frames.end(), frame) != frames.end(); }

bool rises(const Frames& frames) {
  return std::adjacent_find(frames.begin(), frames.end(), std::greater_equal<>()) == frames.end();
}

// Checks all promises of the header for arguments in order and in range.
::testing::AssertionResult keeps_promises(int first, int worst, int last, int count, int tiles) {
  const Frames frames = choose_frames(first, worst, last, count, tiles);
  const bool size = static_cast<int>(frames.size()) == std::min(tiles, count);
  const bool range = frames.empty() || (frames.front() >= 0 && frames.back() < count);
  const bool wanted = has(frames, worst) && (tiles < 2 || has(frames, first)) && (tiles < 3 || has(frames, last));
  if (size && range && wanted && rises(frames)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "choose_frames(" << first << ", " << worst << ", " << last << ", " << count
                                       << ", " << tiles << ") = " << ::testing::PrintToString(frames);
}

TEST(ChooseClip, IsTheHalfSecondAroundAFrameAtHalfSpeed) {
  const Clip clip = choose_clip(100, 200, 60.0);
  EXPECT_EQ(clip.frames.size(), 17u);
  EXPECT_TRUE(has(clip.frames, 100)) << "the worst frame is one of them";
  EXPECT_EQ(clip.frames.front(), 84);
  EXPECT_EQ(clip.frames.back(), 116);
  EXPECT_EQ(clip.milliseconds_per_frame, 66);
}

TEST(ChooseClip, StaysInsideTheMotionAtAnyRate) {
  for (const double rate_hz : {0.5, 24.0, 60.0, 1000.0})
    for (const int count : {1, 2, 30, 5000})
      for (const int middle : {0, count / 2, count - 1}) {
        const Clip clip = choose_clip(middle, count, rate_hz);
        ASSERT_FALSE(clip.frames.empty());
        EXPECT_TRUE(has(clip.frames, middle) && rises(clip.frames));
        EXPECT_TRUE(clip.frames.front() >= 0 && clip.frames.back() < count) << rate_hz << " Hz, " << count;
        EXPECT_LE(clip.frames.size(), 40u);
      }
}

TEST(ChooseFrames, KeepsItsPromisesForEveryShortMotion) {
  for (int tiles = 1; tiles <= 9; ++tiles)
    for (int count = 1; count <= 14; ++count)
      for (int first = 0; first < count; ++first)
        for (int worst = first; worst < count; ++worst)
          for (int last = worst; last < count; ++last) ASSERT_TRUE(keeps_promises(first, worst, last, count, tiles));
}

RC_GTEST_PROP(ChooseFrames, KeepsItsPromisesForLongMotions, ()) {
  const int count = *rc::gen::inRange(1, 1'000'000'000);
  Frames marks = *rc::gen::container<Frames>(3, rc::gen::inRange(0, count));
  std::sort(marks.begin(), marks.end());
  RC_ASSERT(keeps_promises(marks[0], marks[1], marks[2], count, *rc::gen::inRange(1, 65)));
}

RC_GTEST_PROP(ChooseFrames, SurvivesAnyArguments, (int first, int worst, int last)) {
  const Frames frames = choose_frames(first, worst, last, 100, 8);
  RC_ASSERT(frames.size() == 8u);
  RC_ASSERT(rises(frames));
  RC_ASSERT(frames.front() >= 0);
  RC_ASSERT(frames.back() < 100);
}

TEST(ChooseFrames, ShowsWhatWasBeforeAndAfter) {
  const Frames frames = choose_frames(40, 55, 80, 120, 8);
  EXPECT_EQ(frames, (Frames{20, 39, 40, 47, 55, 67, 80, 100}));
}

TEST(ChooseFrames, ShowsAJumpBesideTheFrameBeforeIt) {
  for (const int last : {70, 71, 90})
    for (int tiles = 6; tiles <= 12; ++tiles) EXPECT_TRUE(has(choose_frames(70, 70, last, 120, tiles), 69));
  EXPECT_TRUE(has(choose_frames(119, 119, 119, 120, 8), 118));
}

TEST(ChooseFrames, StaysCloseToAShortFinding) {
  const Frames frames = choose_frames(500, 500, 500, 1000, 8);
  EXPECT_GE(frames.front(), 490);
  EXPECT_LE(frames.back(), 510);
  EXPECT_LT(frames.front(), 500);
  EXPECT_GT(frames.back(), 500);
}

TEST(ChooseFrames, HasNothingToChooseFromNothing) {
  EXPECT_TRUE(choose_frames(0, 0, 0, 0, 8).empty());
  EXPECT_TRUE(choose_frames(0, 0, 0, 10, 0).empty());
}

TEST(SpreadFrames, HasBothEndsAndEvenSteps) {
  EXPECT_EQ(spread_frames(120, 8), (Frames{0, 17, 34, 51, 68, 85, 102, 119}));
  EXPECT_EQ(spread_frames(3, 8), (Frames{0, 1, 2}));
  EXPECT_EQ(spread_frames(5, 1), (Frames{0}));
  EXPECT_TRUE(spread_frames(0, 8).empty());
}

}  // namespace
}  // namespace contort
