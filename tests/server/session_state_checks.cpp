// The state that a session shows, without workers: the test sets the clock, and motions consist of letters.
#include "server/session_state.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "tests/server/played_takes.h"

namespace contort::server {
namespace {

using std::chrono::milliseconds;

const Time kBegin = Time{} + std::chrono::hours(1);

SessionState showing(const std::string& letters) {
  SessionState shown;
  shown.begin_take(take_of(1, letters), {Mode::kinematic}, kBegin);
  return shown;
}

TEST(SessionState, StopsInTheLastFrameAndSaysThatItEnded) {
  SessionState shown = showing("aaaaaaaaaaa");  // 10 Hz: a second
  EXPECT_FALSE(shown.has_ended(kBegin + milliseconds(5000))) << "nothing plays yet";
  shown.play(true, kBegin);
  EXPECT_EQ(shown.frame(kBegin + milliseconds(450)), 4);
  EXPECT_FALSE(shown.has_ended(kBegin + milliseconds(950)));
  EXPECT_EQ(shown.frame(kBegin + milliseconds(5000)), 10);
  EXPECT_TRUE(shown.has_ended(kBegin + milliseconds(1050)));
}

TEST(SessionState, StepsStayWithinTheTake) {
  SessionState shown = showing("aaaaa");
  shown.play(true, kBegin);
  shown.stop_at(99, kBegin);
  EXPECT_EQ(shown.frame(kBegin + milliseconds(900)), 4);
  shown.stop_at(-1, kBegin);
  EXPECT_EQ(shown.frame(kBegin + milliseconds(900)), 0);
  EXPECT_FALSE(shown.clock().playing());
}

TEST(SessionState, KnowsTheFirstFrameThatEditsChangedSinceARevision) {
  SessionState shown = showing("aaaaaa");
  shown.amend_take(take_of(1, "aaaabb"));
  shown.amend_take(take_of(1, "aabbbb"));
  shown.amend_take(take_of(1, "aabbbc"));
  EXPECT_EQ(shown.revision(), 4);
  EXPECT_EQ(shown.first_change(Mode::kinematic, 1, 6), 2);
  EXPECT_EQ(shown.first_change(Mode::kinematic, 3, 6), 5);
  EXPECT_EQ(shown.first_change(Mode::kinematic, 4, 6), 6);
}

TEST(SessionState, AnEditLeavesTheClockAloneAndForgetsWhatWasJudged) {
  SessionState shown = showing("aaaaaa");
  shown.play(true, kBegin);
  shown.set_judged(Mode::kinematic, {1, "\"findings\":[]}"});
  const std::int64_t clock = shown.clock().version();
  shown.amend_take(take_of(1, "aaabbb"));
  EXPECT_EQ(shown.clock().version(), clock);
  EXPECT_EQ(shown.frame(kBegin + milliseconds(250)), 2);
  EXPECT_TRUE(shown.judged().empty());
}

TEST(SessionState, KeepsTheSpecOfTheTakeBefore) {
  SessionState shown = showing("aa");
  shown.begin_take(take_of(2, "bb"), {Mode::kinematic}, kBegin);
  shown.begin_take(take_of(3, "cc"), {Mode::kinematic}, kBegin);
  EXPECT_FALSE(shown.spec_of(1, Mode::kinematic));
  EXPECT_EQ(shown.spec_of(2, Mode::kinematic)->hold_frames, 2);
  EXPECT_EQ(shown.spec_of(3, Mode::kinematic)->hold_frames, 3);
  EXPECT_FALSE(shown.spec_of(3, Mode::dynamic)) << "it was not played so";
}

TEST(SessionState, WantsTheNextTakeWhenTheEndIsNear) {
  SessionState shown = showing(std::string(31, 'a'));
  EXPECT_FALSE(shown.needs_next(kBegin + milliseconds(2000))) << "nothing plays";
  shown.play(true, kBegin);
  EXPECT_FALSE(shown.needs_next(kBegin + milliseconds(1400)));
  EXPECT_TRUE(shown.needs_next(kBegin + milliseconds(1700)));
  shown.set_next(take_of(2, "bb"), shown.revision());
  EXPECT_FALSE(shown.needs_next(kBegin + milliseconds(1700)));
  shown.amend_take(take_of(1, std::string(31, 'b')));
  EXPECT_TRUE(shown.needs_next(kBegin + milliseconds(1700))) << "the one that was made follows another spec";
}

TEST(SessionState, RollsOnToTheNextTakeOrStandsStill) {
  SessionState shown = showing("aaa");
  shown.play(true, kBegin);
  shown.set_next(take_of(2, "bbbb"), shown.revision());
  const Time end = kBegin + milliseconds(300);
  shown.roll(end);
  EXPECT_EQ(shown.take().number, 2);
  EXPECT_EQ(shown.frame(end + milliseconds(150)), 1) << "it plays on from frame 0";
  shown.set_next(std::nullopt, shown.revision());
  shown.roll(end + milliseconds(400));
  EXPECT_EQ(shown.take().number, 2);
  EXPECT_EQ(shown.frame(end + milliseconds(9000)), 3);
  EXPECT_FALSE(shown.clock().playing());
  EXPECT_FALSE(shown.has_tried_next()) << "who plays again has it tried again";
}

TEST(SessionState, ANewTakeStandsWhereTheFigureIsUnlessThatIsNowhere) {
  SessionState shown = showing("aaa");
  PlayedTake take = take_of(2, "aaa");
  take.spec.start.position_m = Vec3(7.0, 0.0, 0.0);
  take.played[Mode::kinematic] = played_with_root_at({0.0F, 1.0F, std::numeric_limits<float>::quiet_NaN()});
  shown.begin_take(take, {Mode::kinematic}, kBegin);
  EXPECT_EQ(shown.standing_spec(0).start.position_m.x, 0.0);
  EXPECT_EQ(shown.standing_spec(1).start.position_m.x, 1.0);
  EXPECT_EQ(shown.standing_spec(2).start.position_m.x, 7.0);
}

TEST(SessionState, NumbersModelsThatDiffer) {
  SessionState shown;
  shown.set_model({"{\"a\":1}", kNoRotation});
  shown.set_model({"{\"a\":1}", kNoRotation});
  EXPECT_EQ(shown.model_number(), 1);
  shown.set_model({"{\"a\":2}", kNoRotation});
  EXPECT_EQ(shown.model_number(), 2);
}

}  // namespace
}  // namespace contort::server
