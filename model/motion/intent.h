// The Intent is what the generator meant to do, and when. Checks of a generator's promises read only this; without an
// intent they cannot judge.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/math.h"
#include "model/motion/motion.h"

namespace contort {

// The layers of a part in the order of their evaluation: overwrite, then ik on top, then additive.
enum class Layer : std::uint8_t { overwrite, ik, additive };
std::string_view layer_name(Layer layer);

// An action on one part, at its place in its sequence. Times are in frames of its sequence.
struct IntendedAction {
  int sequence = 0;  // indices into the spec; sequences of interrupts are numbered after those of the queue
  int clip = 0;
  int action = 0;
  int part = 0;      // index into the character's parts: the part that it moves
  int named = 0;     // the part that the spec names
  std::string name;  // the action's name in the spec
  Layer layer = Layer::overwrite;
  double start = 0.0;
  double end = 0.0;
  double blend_in = 0.0;
  double blend_out = 0.0;
  int first_frame = 0;  // the whole frames in which it moves the part
  int last_frame = 0;
  // True: not requested for this part; the generator moves it too, to fulfil a request for another part.
  bool further = false;
  bool operator==(const IntendedAction&) const = default;
};

// Returns true if this span belongs to this action: an IntendedAction, or a generator's plan of one, with the same four
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
  int part = 0;            // the part whose action has the target
  int socket = 0;          // index into the character's sockets: the point that must reach the target
  // Index of the socket that is the target; it may move. -1: the fixed point target_m is the target.
  int target_socket = -1;
  Vec3 target_m{0.0};      // in the character's frame: on the ground under the root, +Z forward
  bool in_world = false;   // target_m is in the world
  double within_m = 0.0;   // tolerance that the generator declares, if it is larger than the check's
  bool operator==(const Goal&) const = default;
};

// A grasp: the frames in which a hand closes around an object, holds it, or opens. Rigid fingers overlap the object
// meanwhile.
struct Grasp {
  int first_frame = 0;
  int last_frame = -1;  // inclusive
  int joint = 0;        // joint of the character: the bodies on it, and on its descendants, are the hand
  int body = 0;         // index of the object's body in the character
  bool operator==(const Grasp&) const = default;
};

// The reason for which a request cannot be met.
enum class Shortfall : std::uint8_t {
  out_of_reach,  // the limb is too short, or its ground is too high, too low or too steep
  joint_range,
  joint_speed,
  clearance,  // bodies would overlap
  rule_failed,  // the script of a user's action stopped
};
std::string_view shortfall_name(Shortfall shortfall);

// A request that the generator could not meet completely. It is a note, not a fault.
struct UnmetRequest {
  int first_frame = 0;
  int last_frame = -1;  // inclusive
  int part = 0;         // part of the character that was to be moved
  std::string action;   // the action's name in the spec
  Shortfall why = Shortfall::out_of_reach;
  bool operator==(const UnmetRequest&) const = default;
};

struct Intent {
  int queued = 0;  // number of sequences of the spec's own queue; later ones belong to interrupts
  std::vector<IntendedSequence> sequences;
  std::vector<IntendedAction> actions;  // in the spec's order
  std::vector<Goal> goals;
  std::vector<Grasp> grasps;
  std::vector<UnmetRequest> unmet;  // in the order of their first frames
  bool operator==(const Intent&) const = default;
};

}  // namespace contort
