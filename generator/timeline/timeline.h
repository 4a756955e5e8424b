// Timeline: the queue of sequences laid out in frames, with every name resolved.
#pragma once

#include <vector>

#include "generator/actions/action.h"
#include "generator/character/character.h"
#include "generator/core/result.h"
#include "generator/timeline/clip.h"

namespace contort {

inline constexpr int kMaxFrames = 36000;  // of one motion: ten minutes at 60 Hz

// One action at its place in the motion. Times are in frames, with fractions where stretching made them.
struct PlannedAction {
  int sequence = 0;  // indices into the spec
  int clip = 0;
  int action = 0;
  const ActionDef* def = nullptr;
  int part = 0;
  double start = 0.0;
  double end = 0.0;  // >= start
  double speed = 1.0;
  int first_frame = 0;  // the frames that it moves: ceil(start) to ceil(end), rounding forgiven, two at least
  int last_frame = 0;
  std::vector<double> params;
};

struct Timeline {
  std::vector<PlannedAction> actions;     // in spec order
  std::vector<std::vector<int>> of_part;  // indices into actions, per part
  int frame_count = 0;                    // up to the end of the last sequence
};

// Codes spec.unknown_action, .unknown_slot, .unsupported_action, .too_long and those of bind_params, with pointers from
// "/sequences/0" down.
Result<Timeline> lay_out(const std::vector<SequenceDesc>& sequences, const Character& character);

// Progress of an action at a frame, in [0, 1].
double progress(const PlannedAction& action, int frame);

// Minimum-jerk easing from 0 to 1 with no speed or acceleration at either end: 10 u^3 - 15 u^4 + 6 u^5 (Flash and
// Hogan 1985). Its greatest slope is 1.875, in the middle.
double ease(double u);

}  // namespace contort
