// Commands of a terminal as edits of a spec. Plain functions: a spec, and where its motion stands, in; a spec out. An
// edit at a frame changes no frame before it, but for what dynamic control foresees (docs/server.md).
#pragma once

#include <span>
#include <string>

#include "model/core/result.h"
#include "model/motion/motion.h"
#include "model/spec/spec.h"

namespace contort::server {

// The moment up to which a motion has been shown, and what ran until then.
struct Moment {
  int frame = 0;  // the last one that was shown
  std::span<const QueueSpan> queue;
};

// A sequence that enters the queue in the next frame. Code take.full: a spec holds 64 interrupts.
Result<Spec> with_sequence(const Spec& spec, const SequenceDesc& sequence, Enter enter, bool resume, const Moment& now);

struct AimCommand {
  std::string slot;
  std::string action = "aim";  // or look_at
  std::string point;           // of the attached object or the part; "" where the action has none
  Vec3 target_m{0.0};          // in the world
  int duration_frames = 90;    // [1, 6000]
  int blend_frames = 12;       // in and out
};

// Aims in the next frame: beside what runs, as a further clip of that sequence, so that a walk goes on; by itself where
// nothing runs, or where what runs is stretched. Code take.full.
Result<Spec> with_aim(const Spec& spec, const AimCommand& aim, const Moment& now);

struct PushCommand {
  std::string slot;
  std::string joint;      // of that slot's part, by its own name; "": its first one
  Vec3 point_m{0.0};      // in the joint's frame
  Vec3 impulse_N_s{0.0};  // in the world
};

// Strikes in the next frame. Code take.full.
Result<Spec> with_push(const Spec& spec, const PushCommand& push, const Moment& now);

// The same character in the same surroundings with nothing to do, where `root` stands and as it faces;
// `rest` is the root's rotation in the character's rest pose.
Spec next_take(const Spec& spec, const Rigid& root, const Quat& rest);

}  // namespace contort::server
