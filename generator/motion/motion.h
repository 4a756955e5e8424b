// Motion: what the generator makes of a Spec, frame by frame. A value; flat arrays, row = frame.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "generator/character/character.h"

namespace contort {

// One posture: all coordinates (see Character) and where the root is.
struct Posture {
  std::vector<double> coords;
  Rigid root;  // world_from_root
  bool operator==(const Posture&) const = default;
};

// In which frames an action had its layer of a part. Sequences of interrupts are numbered after those of the spec's queue.
struct ActionSpan {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  int sequence = 0;    // indices into the spec
  int clip = 0;
  int action = 0;
  int part = 0;  // of the character
  bool operator==(const ActionSpan&) const = default;
};

// In which frames a sequence ran. In frame f it stood at its own frame first_content + f - first_frame.
struct QueueSpan {
  int first_frame = 0;
  int last_frame = 0;  // inclusive: the frame in which it ended or was cut
  int sequence = 0;
  int first_content = 0;
  bool operator==(const QueueSpan&) const = default;
};

// In which frames an aim was fully in force: come in, not fading, and nothing else on the parts that it moves.
struct AimSpan {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  int socket = 0;      // of the character; its +Z shall point at the target
  Vec3 target_m{0.0};  // in the world
  bool operator==(const AimSpan&) const = default;
};

struct Motion {
  double rate_hz = 60.0;
  int frame_count = 0;
  int coord_count = 0;         // doubles in a row, see Character
  std::vector<double> coords;  // frame_count * coord_count
  std::vector<Rigid> root;     // frame_count: world_from_root
  std::vector<ActionSpan> spans;
  std::vector<QueueSpan> queue;  // the queue's history
  std::vector<AimSpan> aims;     // in the order of their first frames

  std::span<const double> row(int frame) const {
    return std::span(coords).subspan(static_cast<std::size_t>(frame) * static_cast<std::size_t>(coord_count),
                                     static_cast<std::size_t>(coord_count));
  }
  std::span<double> row(int frame) {
    return std::span(coords).subspan(static_cast<std::size_t>(frame) * static_cast<std::size_t>(coord_count),
                                     static_cast<std::size_t>(coord_count));
  }
  bool operator==(const Motion&) const = default;
};

// Hash of rate, root and coordinates, bit by bit. Equal spec text gives the equal hash everywhere
// (docs/determinism.md).
std::uint64_t motion_hash(const Motion& motion);

// Running hash after each frame, 16 bits each: frame f of two motions differs first where these do.
std::vector<std::uint16_t> motion_trace(const Motion& motion);

// First frame at which the traces differ, or -1. Lengths that differ count as a difference at the shorter one's end.
int first_difference(const Motion& a, const Motion& b);

}  // namespace contort
