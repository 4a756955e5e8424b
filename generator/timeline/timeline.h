// Timeline: sequences laid out in frames, with every name resolved.
#pragma once

#include <vector>

#include "generator/actions/action.h"
#include "generator/timeline/queue.h"
#include "model/character/character.h"
#include "model/core/result.h"
#include "model/spec/clip.h"

namespace contort {

// One action on one part, at its place in its sequence. Times are in frames from the sequence's start, with fractions
// due to stretching. An action that moves several parts is planned once for each.
struct PlannedAction {
  int sequence = 0;  // indices into the spec
  int clip = 0;
  int action = 0;
  int use = 0;  // number of the use of an action; equal for all parts that one use moves
  const ActionDef* def = nullptr;
  std::string name;  // the action's name in the spec
  int part = 0;      // the part that it moves
  int named = 0;     // the part that the spec names
  double start = 0.0;
  double end = 0.0;  // >= start
  double speed = 1.0;
  double scale = 1.0;   // frames per frame of content
  int first_frame = 0;  // its frames, ceil(start) to ceil(end) up to rounding errors; at least two
  int last_frame = 0;
  double blend_in = 0.0;  // frames; negative: as long as the distance needs
  double blend_out = 0.0;
  bool cuts = false;  // it takes its part at once, because its use asks for that
  std::vector<double> params;
  std::shared_ptr<const AimPlan> aim;   // only for an action with an own_point
  std::shared_ptr<const KeyPlan> keys;  // only for key poses
  std::shared_ptr<const ScriptPlan> script;  // only for an action with a script
  Vec3 easy_grip_m{0.0};                // for an arm: its comfortable grip place, in the character's frame
  int further = -1;  // index into Timeline::further: it moves its part only after it was acquired; -1: the spec asks
                     // for it
};

// An action that an aim may acquire if its own part cannot point at the target (docs/internals/aim.md).
struct FurtherAction {
  int of_use = 0;  // the use of the aim
  int action = 0;  // index into Timeline::actions; its part is the helping one, a torso or the root
};

// The level that is played alone, with indices of the timeline.
struct Level {
  int sequence = -1;  // index, including sequences of interrupts; -1: the whole spec
  int clip = -1;      // -1: the whole sequence
  int begins = 0;     // frames of its sequence
  int ends = 0;
};

struct Timeline {
  std::vector<PlannedSequence> sequences;  // the spec's, then those of its interrupts
  std::vector<PlannedInterrupt> interrupts;
  int queued = 0;                      // number of sequences that wait in the queue at first
  std::vector<PlannedAction> actions;  // in spec order, each before its further ones
  std::vector<FurtherAction> further;  // in the order of the uses that aim; of one use the torso before the root
  int use_count = 0;
  std::vector<std::vector<int>> of_part;  // indices into actions, by sequence * part_count + part
  // Carriers first; a part that an action reads comes before the parts that the action moves.
  std::vector<int> part_order;
  int frame_count = 0;                    // up to the end of the last sequence, with every interrupt
};

struct TimelineInput {
  const std::vector<SequenceDesc>& sequences;
  const std::vector<InterruptDesc>& interrupts;
  const Character& character;
};

// Codes spec.unknown_action, .unknown_slot, .unsupported_action, .unknown_name, .bad_blend, .too_long, .too_many and
// those of bind_params, with pointers from "/sequences/0" and "/interrupts/0" down.
Result<Timeline> lay_out(const TimelineInput& input);

// Returns true if a course on the ik layer blends in for as long as its distance needs.
bool takes_its_time(const PlannedAction& action);

// Progress of an action at a frame of its sequence, in [0, 1].
double progress(const PlannedAction& action, int frame);

// Return the fraction to which an action has blended in since a course took its part at `came`, and the fraction that
// is left while it fades out; both in [0, 1]. Frames are those of its sequence.
double blended_in(const PlannedAction& action, double came, int frame);
double not_blended_out(const PlannedAction& action, int frame);

// Like blended_in, for an action that has had its part for `held_frames` of the motion: a course that was cut blends in
// again when it continues, because a walk starts with both feet at home, wherever they are. Key poses, on the layer
// overwrite, always start from the part's present posture. Not for an action with automatic blending.
double come_in(const PlannedAction& action, double came, int frame, int held_frames, double rate_hz);

// Minimum-jerk easing from 0 to 1 with no speed or acceleration at either end: 10 u^3 - 15 u^4 + 6 u^5 (Flash and Hogan
// 1985). Its greatest slope is 1.875, in the middle. It is 0 before 0, and 1 after 1.
double ease(double u);

}  // namespace contort
