// A Spec is the action specification: one value that determines everything about one motion. The fuzzer draws it, a
// case stores it, and a person can write it by hand. Its JSON form, limits and schema come from the field lists in
// spec.cpp.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/character/desc.h"
#include "model/core/result.h"
#include "model/spec/clip.h"
#include "model/spec/dynamics_desc.h"
#include "model/world/environment_desc.h"

namespace contort {

// The place and heading of the character in frame 0.
struct StartDesc {
  Vec3 position_m{0.0};      // on the ground: its y has no effect
  double heading_deg = 0.0;  // about +Y; 0 faces +Z
  double ahead_m = 0.0;      // distance of the hips in front of their place over the feet: legs lean from the ankles
  double lower_m = 0.0;      // distance of the hips below their height on stretched legs: knees stay bent
  bool operator==(const StartDesc&) const = default;
};

// An animation file of the library that the character plays instead of sequences.
struct RecordingDesc {
  std::string name;                           // "": none
  std::string clip;                           // clip of that file; "": its first one
  double from_s = 0.0;                        // skips the beginning of the clip, such as a reference pose
  std::map<std::string, std::string> joints;  // joint of the character, by node of the animation, if their names differ
  bool operator==(const RecordingDesc&) const = default;
};

struct Spec {
  CharacterChoice character;
  EnvironmentDesc environment;
  StartDesc start;
  double rate_hz = 60.0;                // [1, 1000] frames per second
  int hold_frames = 0;                  // [0, 6000] frames after the last sequence
  std::vector<SequenceDesc> sequences;  // played in this order
  std::vector<InterruptDesc> interrupts;
  RecordingDesc recording;
  DynamicsDesc dynamics;
  std::string only_slot;  // only the part of this slot moves, as it does in the whole motion; "": all parts move
  int only_sequence = 0;  // only this sequence is played, from the state that earlier ones leave; counted from 1,
                          // sequences of interrupts after those of the queue; 0: all
  int only_clip = 0;      // only this clip of that sequence is played, in the same way; 0: all
  bool operator==(const Spec&) const = default;
};

// Codes "spec.*" and "json.*" with pointers. parse_spec(print_spec(x)) == x for every x that it accepts.
Result<Spec> parse_spec(std::string_view json);

// Prints canonical text: sorted keys, no spaces, defaults left out, shortest numbers that read back to the same bits.
std::string print_spec(const Spec& spec);
std::string pretty_spec(const Spec& spec);  // prints it indented, for people

// Returns the spec's name by its content: content_id of the canonical text.
std::string spec_id(const Spec& spec);

std::string spec_schema();

}  // namespace contort
