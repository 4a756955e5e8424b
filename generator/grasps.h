// Frames in which hands hold objects.
#pragma once

#include <vector>

#include "generator/motion/limb_room.h"
#include "model/core/index.h"
#include "model/motion/intent.h"

namespace contort {

// Frames of one part must come in rising order. Memory is reused.
class GraspRecorder {
 public:
  void begin(std::size_t part_count) { grasp_of_.assign(part_count, -1), grasps_.clear(); }

  void note(int frame, std::size_t part, const HeldObject& held) {
    int& entry = grasp_of_[part];
    if (entry < 0 || held_at(entry) != held || grasps_[at(entry)].last_frame < frame - 1) {
      entry = static_cast<int>(grasps_.size());
      grasps_.push_back({frame, frame, held.joint, held.body});
    }
    grasps_[at(entry)].last_frame = frame;
  }

  // The object that the part held in the previous frame, even if no action holds it any more.
  HeldObject held_before(int frame, std::size_t part) const {
    const int entry = grasp_of_[part];
    return entry >= 0 && grasps_[at(entry)].last_frame == frame - 1 ? held_at(entry) : HeldObject{};
  }

  const std::vector<Grasp>& grasps() const { return grasps_; }

 private:
  HeldObject held_at(int entry) const { return {grasps_[at(entry)].joint, grasps_[at(entry)].body}; }

  std::vector<int> grasp_of_;  // by part: its latest entry, or -1
  std::vector<Grasp> grasps_;
};

}  // namespace contort
