// Records in a motion which actions moved which parts and when. The intent is made from these spans.
#pragma once

#include <array>
#include <vector>

#include "generator/timeline/timeline.h"
#include "model/motion/motion.h"

namespace contort {

// Keeps references to the timeline and the motion from begin() on. Frames come in rising order; entries are in the
// order in which they began.
class SpanRecorder {
 public:
  void begin(const Timeline& timeline, Motion& motion);

  // Records that an action has a layer of its part in this frame, overwrite or ik. One that begins gets an entry of its
  // own.
  void hold(int frame, const PlannedAction& action, bool begins);

  // Records that an additive moves its part in this frame; frames without a break form one entry.
  void additive(int frame, int action);

  // The frame in which an additive began to move its part; -1 if it has not yet.
  int additive_began(int action) const;

  // Extends the latest additive of a part that is still returning after its additives ended, for at most `most_frames`.
  void linger(int frame, int part, int most_frames);

  // Records that an aim is fully in force in this frame, at a target in the world; frames without a break form one
  // entry.
  void aim(int frame, int action, const Vec3& target_m);

 private:
  int add_span(int frame, const PlannedAction& action);

  const Timeline* timeline_ = nullptr;
  Motion* motion_ = nullptr;
  std::vector<std::array<int, 2>> held_;  // by part: the entries of the actions that have overwrite and ik
  std::vector<int> additives_;            // entry of each action, or -1
  std::vector<int> aims_;
  // The entry, by part, of the additive that ended last, and its last frame.
  std::vector<std::array<int, 2>> latest_;
};

}  // namespace contort
