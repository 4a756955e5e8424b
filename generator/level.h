// One level of a spec: a sequence or a clip that is played alone, from the state that the earlier ones leave.
#pragma once

#include <span>

#include "generator/timeline/timeline.h"

namespace contort {

// Follows the queue until the level is over. If the whole spec is played, no level begins.
class LevelPlay {
 public:
  void begin(const Level& level);

  // Call it once for each frame, after the queue.
  void advance(int frame, std::span<const QueueSpan> history);

  bool has_begun() const { return first_frame_ >= 0; }
  int first_frame() const { return first_frame_; }  // -1 before it has begun
  bool is_over() const { return is_over_; }
  int last_frame() const { return last_frame_; }  // the last frame so far

  // Returns true if an action is not part of the level, so that its part stays where it is in the level's first frame.
  bool is_left_out(const PlannedAction& action, int frame) const {
    return has_begun() && frame > first_frame_ &&
           (action.sequence != level_.sequence || (level_.clip >= 0 && action.clip != level_.clip));
  }

 private:
  Level level_;
  int first_frame_ = -1;
  int last_frame_ = -1;
  bool is_over_ = false;
};

}  // namespace contort
