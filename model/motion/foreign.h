// Data of a generator that is a program of its own, which coordinates cannot hold. Checks of such generators use them
// (docs/reference/guests.md).
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "model/core/math.h"

namespace contort {

// The reason for which a motion should be equal to another one.
enum class Equality : std::uint8_t {
  rest,     // an action brings the figure to its rest pose
  fresh,    // an action gives the same motion as if it were the only one
  none,     // an action changes nothing
  history,  // requests before this one change nothing
  rate,     // the rate changes nothing
  undo,     // an action has no effect any more after its end
  gain,     // nearly equal parameters give nearly equal motions
  mirror,   // the request for the other side gives the mirror image
};

// Frames of another motion of the same character. Its frame i belongs to the motion's frame first_frame + i * step.
struct EqualMotion {
  Equality why = Equality::rest;
  int first_frame = 0;
  int step = 1;
  std::vector<double> coords;  // a row for each frame, as in Motion
  std::vector<Rigid> root;
  bool operator==(const EqualMotion&) const = default;
};

// The frames in which a channel of the generator had the same value: a text that is not empty, or a flag that is set,
// whose value is "".
struct ChannelRun {
  std::string channel;
  std::string value;
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  bool operator==(const ChannelRun&) const = default;
};

struct ChannelNumbers {
  std::string channel;
  std::vector<double> values;  // one for each frame
  bool operator==(const ChannelNumbers&) const = default;
};

// The frames in which a joint stands still in the world, according to the generator.
struct ContactRun {
  int joint = 0;
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  bool operator==(const ContactRun&) const = default;
};

struct FrameSpan {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  bool operator==(const FrameSpan&) const = default;
};

struct ForeignFacts {
  std::vector<double> quaternion_lengths;  // frames x joints, as received; 1 for a rotation
  std::vector<double> off_axis_rad;        // frames x joints: for hinges, the rotation that is not about their axis
  std::vector<int> jumps;                  // ascending frames into which the pose may jump from the frame before
  std::vector<EqualMotion> equals;
  std::vector<ChannelRun> runs;  // by channel, then by frame
  std::vector<ChannelNumbers> numbers;
  std::vector<ContactRun> contacts;
  std::vector<FrameSpan> travels{};  // frames into which the root may jump, but not the pose
  double root_max_speed_rad_s = std::numeric_limits<double>::infinity();  // greatest turning speed of the root
  bool operator==(const ForeignFacts&) const = default;

  bool may_jump_into(int frame) const;
  bool may_root_jump_into(int frame) const;
  bool compares(Equality why) const;
};

}  // namespace contort
