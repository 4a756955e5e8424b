// What is to be played: actions in clips, clips in sequences, sequences one after another. Plain values, part of a
// Spec.
#pragma once

#include <string>
#include <vector>

#include "generator/actions/action_use.h"

namespace contort {

// Actions that belong together. Its natural length is the end of its last action.
struct ClipDesc {
  std::string name;         // for reports; may be empty
  int start_frame = 0;      // [0, 36000], from the sequence's start
  int duration_frames = 0;  // 0: natural length; else the content is stretched to this
  double speed = 1.0;       // [0.1, 10]; divides the length
  std::vector<ActionUse> actions;
  bool operator==(const ClipDesc&) const = default;
};

// Clips on one time line, stretched as a whole in the same way. Sequences wait in a queue: first in, first out.
struct SequenceDesc {
  std::string name;
  int duration_frames = 0;
  std::vector<ClipDesc> clips;
  bool operator==(const SequenceDesc&) const = default;
};

}  // namespace contort
