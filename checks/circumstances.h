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
  interrupt,    // up to 0.15 s after an interrupt cut in or handed back: as long as what was cut fades
  clip_switch,  // within a frame of where a clip or sequence begins or ends
  blend,        // an action comes in or fades out
  mid_clip,     // actions move, and nothing changes
  at_rest,      // no action moves: a motion's end, or a recording
};
std::span<const std::string_view> phase_names();  // in the order of the enum
std::string_view phase_name(Phase phase);

struct ActiveAction {
  std::string name;     // "walk"
  std::string slot;     // that the spec names
  std::string pointer;  // into the spec: "/sequences/0/clips/1/actions/2"
  bool operator==(const ActiveAction&) const = default;
};

struct Circumstances {
  Phase phase = Phase::at_rest;
  std::vector<ActiveAction> actions;  // that moved some part in this frame, in the spec's order
  bool operator==(const Circumstances&) const = default;
};

// The circumstances of one frame, in [0, frame_count), of a motion. The intent is that of the motion's generator.
Circumstances circumstances_of(const Intent& intent, const Character& character, const Motion& motion, int frame);
Phase phase_of(const Intent& intent, const Motion& motion, int frame);
std::vector<Phase> phases_of(const Intent& intent, const Motion& motion);  // of every frame

}  // namespace contort
