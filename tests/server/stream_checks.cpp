// The events by which a stream sends a session's state.
#include "server/stream.h"

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "tests/server/played_takes.h"

namespace contort::server {
namespace {

using std::chrono::milliseconds;
using StreamJson = nlohmann::json;

const Time kStart = Time{} + std::chrono::hours(1);

// "take clock frames[0,16) spans": names of events, with the frames that they hold.
std::string told(const std::vector<Event>& events) {
  std::string text;
  for (const Event& event : events) {
    text += (text.empty() ? "" : " ") + event.name;
    const StreamJson data = StreamJson::parse(event.data);
    if (event.name != "frames") continue;
    const int from = data.at("from"), count = data.at("count");
    text += "[" + std::to_string(from) + "," + std::to_string(from + count) + ")";
  }
  return text;
}

struct Stream {
  SessionState shown;
  StreamState state;

  explicit Stream(const std::string& letters) {
    shown.begin_take(take_of(1, letters), {Mode::kinematic}, kStart);
  }
  std::string next(int ms = 0) { return told(events_of(shown, state, kStart + milliseconds(ms))); }
};

TEST(Stream, BeginsWithTheTakeAndIsSilentUntilSomethingChanges) {
  Stream stream("aaaa");
  EXPECT_EQ(stream.next(), "take clock frames[0,4) spans");
  EXPECT_EQ(stream.next(), "");
  EXPECT_EQ(stream.next(60000), "") << "the clock stands";
}

TEST(Stream, SendsFramesAheadOfTheClockAndMoreBeforeTheyRunOut) {
  Stream stream(std::string(100, 'a'));
  EXPECT_EQ(stream.next(), "take clock frames[0,16) spans");
  stream.shown.play(true, kStart);
  EXPECT_EQ(stream.next(), "clock");
  EXPECT_EQ(stream.next(400), "") << "there is more than a second left";
  EXPECT_EQ(stream.next(600), "frames[16,22)");
}

TEST(Stream, TellsTheTimeOnceASecondWhileItPlays) {
  Stream stream("aaaa");
  stream.shown.play(true, kStart);
  stream.next();
  EXPECT_EQ(stream.next(900), "");
  EXPECT_EQ(stream.next(1100), "clock");
  EXPECT_EQ(stream.next(1200), "");
}

TEST(Stream, SendsWhatAnEditChangedFirstWhatIsToCome) {
  Stream stream("aaaaaaaa");
  stream.next();
  stream.shown.stop_at(4, kStart);
  stream.next();
  stream.shown.amend_take(take_of(1, "aaaaabbb"));
  EXPECT_EQ(stream.next(), "frames[5,8) spans");
  stream.shown.amend_take(take_of(1, "aacccccc"));
  EXPECT_EQ(stream.next(), "frames[4,8) frames[2,4) spans");
}

TEST(Stream, SendsLongMotionsInPieces) {
  Stream stream(std::string(600, 'a'));
  stream.shown.stop_at(500, kStart);
  stream.next();
  stream.shown.restart(kStart);
  EXPECT_EQ(stream.next(), "clock frames[0,16)");
  stream.shown.stop_at(599, kStart);
  EXPECT_EQ(stream.next(), "clock frames[16,256) frames[256,496) frames[496,600)");
}

TEST(Stream, TellsMarginsAndProblemsOnce) {
  Stream stream("aaaa");
  stream.next();
  stream.shown.set_judged(Mode::kinematic, {1, "\"findings\":[]}"});
  stream.shown.set_problem("{\"code\":\"work.timeout\"}");
  EXPECT_EQ(stream.next(), "margins problem");
  EXPECT_EQ(stream.next(), "");
}

TEST(Stream, BeginsAgainWithEachTake) {
  Stream stream("aaaa");
  stream.next();
  stream.shown.begin_take(take_of(2, "bb"), {Mode::kinematic}, kStart);
  EXPECT_EQ(stream.next(), "take clock frames[0,2) spans");
}

}  // namespace
}  // namespace contort::server
