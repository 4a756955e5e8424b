// Turns a client's commands into edits of a spec. The functions are pure: they take a spec and the position of its
// motion, and return a spec. An edit at a frame changes no earlier frame, except what dynamic control foresees
// (docs/reference/server.md).
#pragma once

#include <span>
#include <string>

#include "model/core/result.h"
#include "model/motion/motion.h"
#include "model/spec/spec.h"

namespace contort::server {

// The moment up to which a motion has been shown, and the queue until then.
struct Moment {
  int frame = 0;  // the frame that was shown last
  std::span<const QueueSpan> queue;
};

// Adds a sequence that enters the queue in the next frame. Code take.full: a spec has at most 64 interrupts.
Result<Spec> with_sequence(const Spec& spec, const SequenceDesc& sequence, Enter enter, bool resume, const Moment& now);

struct AimCommand {
  std::string slot;
  std::string action = "aim";  // or look_at
  std::string point;           // point of the attached object or the part; "" if the action has none
  Vec3 target_m{0.0};          // in the world
  int duration_frames = 90;    // [1, 6000]
  int blend_frames = 12;       // in and out
};

// Aims in the next frame. The aim becomes a further clip of the running sequence, so that a walk continues; it
// becomes a sequence of its own if nothing runs or the running sequence is stretched. Code take.full.
Result<Spec> with_aim(const Spec& spec, const AimCommand& aim, const Moment& now);

struct PushCommand {
  std::string slot;
  std::string joint;      // joint of that slot's part, by its own name; "": its first joint
  Vec3 point_m{0.0};      // in the joint's frame
  Vec3 impulse_N_s{0.0};  // in the world
};

// Adds an impact in the next frame. Code take.full.
Result<Spec> with_push(const Spec& spec, const PushCommand& push, const Moment& now);

// Returns a spec without actions for the same character in the same surroundings, with the position and heading of
// `root`. `rest` is the root's rotation in the character's rest pose.
Spec next_take(const Spec& spec, const Rigid& root, const Quat& rest);

}  // namespace contort::server
