// The motion that a spec describes: actions in clips, clips in sequences, sequences one after another. Plain values,
// part of a Spec.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/spec/action_use.h"

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

// Returns the end of the clip's last action, in frames of its content.
double natural_length(const ClipDesc& clip);

// Returns `wanted`, or the natural length if `wanted` is 0.
double stretched(double natural, int wanted_frames);

// Returns the clip's length in frames of its sequence's content: natural or stretched, and at the clip's speed.
double clip_length(const ClipDesc& clip);

// Clips on one time line, stretched as a whole in the same way. Sequences wait in a queue: first in, first out.
struct SequenceDesc {
  std::string name;
  int duration_frames = 0;
  std::vector<ClipDesc> clips;
  bool operator==(const SequenceDesc&) const = default;
};

// An interrupt waits for an event; docs/reference/timeline.md describes each one.
enum class Event { frame, clip_ended, sequence_ended, contact, aim_reached, impact, near_obstacle, ground_steeper };
std::span<const std::string_view> event_names();  // in the order of the enum
inline std::string_view event_name(Event event) { return event_names()[static_cast<std::size_t>(event)]; }

struct ConditionDesc {
  Event event = Event::frame;
  int frame = 0;            // frame: [0, 36000]
  std::string name;         // clip_ended, sequence_ended: its name; near_obstacle: the obstacle's, "" for any
  std::string slot;         // contact, aim_reached
  double distance_m = 1.0;  // near_obstacle: from the root
  double slope_deg = 10.0;  // ground_steeper
  bool operator==(const ConditionDesc&) const = default;
};

enum class Enter { front, after_clip, after_sequence, end };

// A sequence that enters the queue when its condition holds for the first time.
struct InterruptDesc {
  ConditionDesc when;
  Enter enter = Enter::front;
  std::string after;  // after_sequence: the name of that sequence
  bool resume = true;
  SequenceDesc sequence;
  bool operator==(const InterruptDesc&) const = default;
};

}  // namespace contort
