// A Motion is the generator's result for a Spec, frame by frame. It is a value with flat arrays; a row is a frame.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/character/character.h"

namespace contort {

// One posture: all coordinates (see Character) and the root's transform.
struct Posture {
  std::vector<double> coords;
  Rigid root;  // world_from_root
  bool operator==(const Posture&) const = default;
};

// The frames in which an action controlled its layer of a part. Sequences of interrupts are numbered after those of
// the spec's queue.
struct ActionSpan {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  int sequence = 0;    // indices into the spec
  int clip = 0;
  int action = 0;
  int part = 0;  // index into the character's parts
  bool operator==(const ActionSpan&) const = default;
};

// The frames in which a sequence ran. In frame f it was at its own frame first_content + f - first_frame.
struct QueueSpan {
  int first_frame = 0;
  int last_frame = 0;  // inclusive: the frame in which it ended or was cut
  int sequence = 0;
  int first_content = 0;
  bool operator==(const QueueSpan&) const = default;
};

// The frames in which an aim was fully in force: blended in, not fading out, with nothing else on the parts that it
// moves.
struct AimSpan {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  int socket = 0;      // socket of the character, whose +Z must point at the target
  Vec3 target_m{0.0};  // in the world
  bool operator==(const AimSpan&) const = default;
};

// The footing of a simulated figure in a frame.
enum class Footing : std::uint8_t {
  standing,  // on its soles, flat
  airborne,  // on nothing
  tipping,   // on edges or corners of soles
  fallen,    // on anything else, or nearly lying
};

struct Stance {
  Footing footing = Footing::standing;
  bool overpowered = false;   // a joint needed more than its strength to hold the pose
  std::uint8_t planned = 0;   // bit i: leg i stands in the target motion
  std::uint8_t standing = 0;  // bit i: leg i stands
  // Zero moment point of a standing figure, in the tick in which it was nearest to the edge of the support.
  Vec3 zmp_m{0.0};
  double margin_m = 0.0;      // distance of the zero moment point inside the support area; < 0 outside
  bool operator==(const Stance&) const = default;
};

// An impact that occurred.
struct ImpactMark {
  int frame = 0;
  int joint = 0;
  Vec3 point_m{0.0};      // the point that was hit, in the world, at the time of the impact
  Vec3 impulse_N_s{0.0};  // in the world
  bool operator==(const ImpactMark&) const = default;
};

// The effects of dynamics, frame by frame. Empty in kinematic motions.
struct Response {
  int dof_count = 0;                  // six for the root, then those of the joints in order; see dynamics/multibody.h
  std::vector<double> target_coords;  // frames x coord_count: the motion that was followed
  std::vector<Rigid> target_root;     // frames
  std::vector<double> efforts;        // frames x dof_count: greatest effort in the frame, N m or N; 0 for the root
  std::vector<double> control;        // frames x dof_count: accelerations by dynamic control
  std::vector<Stance> stances;        // frames
  std::vector<ImpactMark> impacts;
  bool operator==(const Response&) const = default;
};

struct Motion {
  double rate_hz = 60.0;
  int frame_count = 0;
  int first_frame = 0;         // earlier frames only lead up to it, and are neither judged nor shown
  int coord_count = 0;         // doubles in a row, see Character
  std::vector<double> coords;  // frame_count * coord_count
  std::vector<Rigid> root;     // frame_count: world_from_root
  // The time of each frame, ascending, for motions with uneven steps from elsewhere; rate_hz is then the mean rate.
  // Empty: the time of a frame is frame / rate_hz.
  std::vector<double> times_s;
  std::vector<ActionSpan> spans;
  std::vector<QueueSpan> queue;  // the queue's history
  std::vector<AimSpan> aims;     // in the order of their first frames
  Response response;

  std::span<const double> row(int frame) const {
    return std::span(coords).subspan(static_cast<std::size_t>(frame) * static_cast<std::size_t>(coord_count),
                                     static_cast<std::size_t>(coord_count));
  }
  std::span<double> row(int frame) {
    return std::span(coords).subspan(static_cast<std::size_t>(frame) * static_cast<std::size_t>(coord_count),
                                     static_cast<std::size_t>(coord_count));
  }
  double time_s(int frame) const {
    return times_s.empty() ? frame / rate_hz : times_s[static_cast<std::size_t>(frame)];
  }
  // Returns 1 / (time from the frame before to `frame`), in Hz; `frame` >= 1.
  double rate_into_hz(int frame) const {
    return times_s.empty() ? rate_hz : 1.0 / (time_s(frame) - time_s(frame - 1));
  }
  bool operator==(const Motion&) const = default;
};

// Returns a hash of rate, root and coordinates, bit by bit. Equal specs give equal hashes on all machines
// (docs/internals/determinism.md).
std::uint64_t motion_hash(const Motion& motion);

// Returns a running hash after each frame, 16 bits each. Two motions differ first in the frame in which their traces
// do.
std::vector<std::uint16_t> motion_trace(const Motion& motion);

// Returns the first frame at which the traces differ, or -1. Different lengths count as a difference at the end of
// the shorter one.
int first_difference(const Motion& a, const Motion& b);

}  // namespace contort
