// Writes into a motion which actions moved what and when: the spans that its intent is made from.
#pragma once

#include <array>
#include <vector>

#include "generator/timeline/timeline.h"
#include "model/motion/motion.h"

namespace contort {

// Keeps references to the timeline and the motion from begin() on. Frames come in rising order; entries stand in the
// order in which they began.
class SpanRecorder {
 public:
  void begin(const Timeline& timeline, Motion& motion);

  // An action has a layer of its part in this frame, overwrite or ik. One that begins gets an entry of its own.
  void hold(int frame, const PlannedAction& action, bool begins);

  // An additive moves its part in this frame: one entry for as long as it does so without a break.
  void additive(int frame, int action);

  // The frame in which an additive began to move its part; -1: it has not yet.
  int additive_began(int action) const;

  // A part whose additives are over is still on its way back: the latest of them goes on, for `most_frames` at most.
  void linger(int frame, int part, int most_frames);

  // An aim is fully in force in this frame, at a target in the world: one entry for as long as it is, without a break.
  void aim(int frame, int action, const Vec3& target_m);

 private:
  int add_span(int frame, const PlannedAction& action);

  const Timeline* timeline_ = nullptr;
  Motion* motion_ = nullptr;
  std::vector<std::array<int, 2>> held_;  // by part: the entry of the action that has overwrite, and ik
  std::vector<int> additives_;            // by action: its entry, or -1
  std::vector<int> aims_;
  std::vector<std::array<int, 2>> latest_;  // by part: the entry of the additive that ended last, and its own last frame
};

}  // namespace contort
