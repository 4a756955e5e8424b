// A motion of a session, the take that it belongs to, and the clock by which it is shown.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/core/math.h"
#include "model/motion/motion.h"
#include "server/work.h"

namespace contort::server {

using Time = std::chrono::steady_clock::time_point;
inline Time now() { return std::chrono::steady_clock::now(); }
inline double seconds_since(Time since) { return std::chrono::duration<double>(now() - since).count(); }

// Counts the frames that pass while it plays.
class PlayClock {
 public:
  void set(int frame, bool playing, Time now) { frame_ = frame, playing_ = playing, since_ = now, ++version_; }
  bool playing() const { return playing_; }
  std::int64_t version() const { return version_; }  // changes with each call of set
  // The present frame; 0 is the first, and there is no last one.
  int frame(double rate_hz, Time now) const;

 private:
  int frame_ = 0;
  bool playing_ = false;
  Time since_{};
  std::int64_t version_ = 0;
};

// A motion of the take, in one mode.
struct Played {
  int frame_count = 0;
  int joint_count = 0;
  double rate_hz = 60.0;
  std::string motion_hash;
  std::string frames;  // compact
  std::vector<QueueSpan> queue;
  std::string spans;  // fields of the event except take, revision and mode

  int frame_bytes() const { return joint_count * kJointBytes; }
  // Returns at most `count` compact frames, in the form that is sent; "" beyond the end.
  std::string frames_from(int from, int count) const;
  // Returns the first frame in which the compact frames of two motions of one take differ in any bit.
  int first_difference(const Played& other) const;
  // The transform of the root in the world, with a unit rotation unless the motion has NaN or infinite values.
  Rigid root(int frame) const;
};

// Reads a worker's reply to TaskKind::play. Code work.damaged.
Result<std::shared_ptr<const Played>> played_of(const Reply& reply);

// One spec in the modes in which it is played. Takes of a session are numbered from 1.
struct PlayedTake {
  int number = 1;
  Spec spec;
  std::map<Mode, std::shared_ptr<const Played>> played;
};

}  // namespace contort::server
