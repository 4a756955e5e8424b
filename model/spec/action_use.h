// One use of an action in a spec. Plain values.
#pragma once

#include <map>
#include <string>

#include "model/character/action_desc.h"

namespace contort {

// One registered action on one part. Frames count from the clip's start.
struct ActionUse {
  std::string action = "pose";
  std::string slot;
  int start_frame = 0;       // [0, 36000]
  int duration_frames = 30;  // [0, 36000]; a longer period plays slower
  double speed = 1.0;        // [0.1, 10]; progress within the period: at 2 the target is reached halfway, then held
  // [0, 600], frames of content in which a course blends in; 0 is a cut. -1: the time follows from the distance
  // (docs/reference/timeline.md).
  int blend_in_frames = -1;
  int blend_out_frames = 0;  // [0, 600], frames of content in which the action fades out before its end
  std::map<std::string, ParamValue> params;  // by the names that the action declares; missing ones have their defaults
  bool operator==(const ActionUse&) const = default;
};

}  // namespace contort
