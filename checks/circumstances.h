// Describes the circumstances of a finding: the actions that moved the figure, and the event that had just happened.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/motion/intent.h"
#include "model/motion/motion.h"

namespace contort {

// The phase of a frame: the first in this list that applies, from the most violent on.
enum class Phase {
  impact,       // up to half a second after a blow
  interrupt,    // up to 0.15 s after an interrupt cut in or returned control, while the action that was cut fades out
  clip_switch,  // within one frame of the start or end of a clip or sequence
  blend,        // an action blends in or out
  mid_clip,     // actions move the figure, and none of the above applies
  at_rest,      // no action moves the figure, as at a motion's end or in a recording
};
std::span<const std::string_view> phase_names();  // in the order of the enum
std::string_view phase_name(Phase phase);

struct ActiveAction {
  std::string name;     // "walk"
  std::string slot;     // the slot that the spec names
  std::string pointer;  // into the spec: "/sequences/0/clips/1/actions/2"
  bool operator==(const ActiveAction&) const = default;
};

struct Circumstances {
  Phase phase = Phase::at_rest;
  std::vector<ActiveAction> actions;  // the actions that moved some part in this frame, in the spec's order
  bool operator==(const Circumstances&) const = default;
};

// The circumstances of one frame, in [0, frame_count), of a motion. The intent is that of the motion's generator.
Circumstances circumstances_of(const Intent& intent, const Character& character, const Motion& motion, int frame);
Phase phase_of(const Intent& intent, const Motion& motion, int frame);
std::vector<Phase> phases_of(const Intent& intent, const Motion& motion);  // returns the phase of every frame

}  // namespace contort
