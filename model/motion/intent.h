// The Intent says what the generator meant, and when. Checks of a generator's promises read it and nothing else of
// the generator; without an intent they cannot judge.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/math.h"
#include "model/motion/motion.h"

namespace contort {

// Order of evaluation on one part: overwrite, then ik on top, then additive.
enum class Layer : std::uint8_t { overwrite, ik, additive };
std::string_view layer_name(Layer layer);

// An action on one part, at its place in its sequence. Times are in frames of its sequence.
struct IntendedAction {
  int sequence = 0;  // indices into the spec; sequences of interrupts are numbered after those of the queue
  int clip = 0;
  int action = 0;
  int part = 0;      // of the character: the part that it moves
  int named = 0;     // the part that the spec names
  std::string name;  // that the spec uses
  Layer layer = Layer::overwrite;
  double start = 0.0;
  double end = 0.0;
  double blend_in = 0.0;
  double blend_out = 0.0;
  int first_frame = 0;  // the whole frames in which it moves the part
  int last_frame = 0;
  bool further = false;  // the generator added it on this part, to carry out what was asked for on the named one
  bool operator==(const IntendedAction&) const = default;
};

// Returns true if this is a span of this action: an IntendedAction, or a generator's plan of one, with the same four
// indices.
template <class Action>
bool is_of(const ActionSpan& span, const Action& action) {
  return span.sequence == action.sequence && span.clip == action.clip && span.action == action.action &&
         span.part == action.part;
}

struct IntendedClip {
  int start = 0;  // frames of its sequence
  int end = 0;
  bool operator==(const IntendedClip&) const = default;
};

struct IntendedSequence {
  int length = 0;  // frames
  std::vector<IntendedClip> clips;
  bool operator==(const IntendedSequence&) const = default;
};

// A goal: the frames in which a point of the figure was to be at another point.
struct Goal {
  int first_frame = 0;
  int last_frame = -1;     // inclusive
  int part = 0;            // that was sent
  int socket = 0;          // of the character: what shall be there
  int target_socket = -1;  // another socket of the character, wherever it is by then; -1: target_m
  Vec3 target_m{0.0};      // in the character's frame: on the ground under the root, +Z forward
  bool in_world = false;   // target_m is in the world
  double within_m = 0.0;   // the distance that the generator allows itself, where it is more than a check would
  bool operator==(const Goal&) const = default;
};

// A grasp: the frames in which a hand takes hold of an object, holds it, or lets go of it. Rigid fingers that close
// around an object overlap it.
struct Grasp {
  int first_frame = 0;
  int last_frame = -1;  // inclusive
  int joint = 0;        // of the character: the bodies on it, and on joints beyond it, are the hand
  int body = 0;         // of the character: the object
  bool operator==(const Grasp&) const = default;
};

// The reason for which a request cannot be met.
enum class Shortfall : std::uint8_t {
  out_of_reach,  // the limb is too short, or what it stands on too high, too low or too steep
  joint_range,
  joint_speed,
  clearance,  // bodies would overlap
  rule_failed,  // a rule that a user wrote stopped
};
std::string_view shortfall_name(Shortfall shortfall);

// A request that the generator could not meet: it came as near as it could. It is a note, not a fault.
struct UnmetRequest {
  int first_frame = 0;
  int last_frame = -1;  // inclusive
  int part = 0;         // of the character: the part that was to be moved
  std::string action;   // the name that the spec uses
  Shortfall why = Shortfall::out_of_reach;
  bool operator==(const UnmetRequest&) const = default;
};

struct Intent {
  int queued = 0;  // sequences of the spec's own queue; those that follow belong to interrupts
  std::vector<IntendedSequence> sequences;
  std::vector<IntendedAction> actions;  // in the spec's order
  std::vector<Goal> goals;
  std::vector<Grasp> grasps;
  std::vector<UnmetRequest> unmet;  // in the order of their first frames
  bool operator==(const Intent&) const = default;
};

}  // namespace contort
