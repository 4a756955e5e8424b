// Field lists (json_fields.h) of specs and their parts. Included from .cpp files only.
#pragma once

#include "model/character/desc.h"
#include "model/character/param_fields.h"
#include "model/core/json_fields.h"
#include "model/spec/spec.h"
#include "model/world/environment_fields.h"

namespace contort {

inline const json_fields::Rule kFrames{.low = 0, .high = 36000};
inline const json_fields::Rule kBlendIn{.low = -1, .high = 600};
inline const json_fields::Rule kBlendOut{.low = 0, .high = 600};
inline const json_fields::Rule kSpeed{.low = 0.1, .high = 10};
inline const json_fields::Rule kOptionalLabel{.text = json_fields::Text::label, .may_be_empty = true};

template <class V>
void fields(V& v, const ActionUse*) {
  v.field("action", &ActionUse::action, {.required = true}, "A registered action; see `contort list actions`.");
  v.field("slot", &ActionUse::slot, {.required = true}, "The slot whose part moves.");
  v.field("start_frame", &ActionUse::start_frame, kFrames, "First frame, counted from the start of the clip.");
  v.field("duration_frames", &ActionUse::duration_frames, kFrames, "Period of the action; a longer one plays slower.");
  v.field("speed", &ActionUse::speed, kSpeed, "Speed of progress within the period.");
  v.field("blend_in_frames", &ActionUse::blend_in_frames, kBlendIn,
          "Duration of the blend at the beginning of a course; 0 is a cut, -1 takes as long as the distance needs.");
  v.field("blend_out_frames", &ActionUse::blend_out_frames, kBlendOut, "Duration of the fade before the end.");
  v.field("params", &ActionUse::params, {.max_count = 64}, "Parameters by the names that the action declares.");
}

template <class V>
void fields(V& v, const ClipDesc*) {
  v.field("name", &ClipDesc::name, kOptionalLabel, "Name for reports.");
  v.field("start_frame", &ClipDesc::start_frame, kFrames, "First frame, counted from the start of the sequence.");
  v.field("duration_frames", &ClipDesc::duration_frames, kFrames,
          "Length to which the clip is stretched; 0 keeps its natural length.");
  v.field("speed", &ClipDesc::speed, kSpeed, "Speed, by which the length is divided.");
  v.field("actions", &ClipDesc::actions, {.max_count = 256}, "Actions that run in this clip.");
}

template <class V>
void fields(V& v, const SequenceDesc*) {
  v.field("name", &SequenceDesc::name, kOptionalLabel, "Name for reports.");
  v.field("duration_frames", &SequenceDesc::duration_frames, kFrames,
          "Length to which the sequence is stretched; 0 keeps its natural length.");
  v.field("clips", &SequenceDesc::clips, {.max_count = 256}, "Clips on one time line.");
}

inline constexpr std::string_view kEnterNames[] = {"front", "after_clip", "after_sequence", "end"};

template <class V>
void fields(V& v, const ConditionDesc*) {
  v.field("event", &ConditionDesc::event, {.names = event_names(), .required = true}, "Event of the condition.");
  v.field("frame", &ConditionDesc::frame, kFrames, "For frame: the frame of the motion.");
  v.field("name", &ConditionDesc::name, kOptionalLabel,
          "For clip_ended, sequence_ended and near_obstacle: name of the clip, sequence or obstacle.");
  v.field("slot", &ConditionDesc::slot, {.may_be_empty = true},
          "For contact and aim_reached: slot of the part that is watched.");
  v.field("distance_m", &ConditionDesc::distance_m, {.low = 0, .high = 1000},
          "For near_obstacle: distance from the root.");
  v.field("slope_deg", &ConditionDesc::slope_deg, {.low = 0, .high = 90}, "For ground_steeper: slope under the root.");
}

template <class V>
void fields(V& v, const InterruptDesc*) {
  v.field("when", &InterruptDesc::when, {.required = true},
          "Condition that starts the interrupt in the first frame in which it holds.");
  v.field("enter", &InterruptDesc::enter, {.names = kEnterNames}, "Place in the queue where the sequence enters.");
  v.field("after", &InterruptDesc::after, kOptionalLabel, "For after_sequence: the name of that sequence.");
  v.field("resume", &InterruptDesc::resume, {},
          "Whether the interrupted sequence continues afterwards; otherwise its rest is dropped.");
  v.field("sequence", &InterruptDesc::sequence, {.required = true}, "Sequence that enters the queue.");
}

template <class V>
void fields(V& v, const StartDesc*) {
  v.field("position_m", &StartDesc::position_m, {.low = -1000, .high = 1000},
          "Position on the ground, at whatever height the ground has there.");
  v.field("heading_deg", &StartDesc::heading_deg, {.low = -360, .high = 360},
          "Heading of the character: 0 faces +Z, 90 faces +X.");
  v.field("ahead_m", &StartDesc::ahead_m, {.low = -0.3, .high = 0.3},
          "Distance by which the hips are ahead of the feet.");
  v.field("lower_m", &StartDesc::lower_m, {.low = 0, .high = 0.3},
          "Distance by which the hips stay lower than on stretched legs.");
}

template <class V>
void fields(V& v, const LoadDesc*) {
  v.field("slot", &LoadDesc::slot, {.required = true}, "The slot whose part carries it.");
  v.field("socket", &LoadDesc::socket, {.required = true}, "A socket of that part.");
  v.field("position_m", &LoadDesc::position_m, {.low = -10, .high = 10},
          "Centre of the box in the frame of the socket.");
  v.field("size_m", &LoadDesc::size_m, {.low = 0.001, .high = 10}, "Size along the axes of the socket.");
  v.field("mass_kg", &LoadDesc::mass_kg, {.low = 0.001, .high = 10000}, "Mass, spread evenly over the box.");
}

template <class V>
void fields(V& v, const ImpactDesc*) {
  v.field("frame", &ImpactDesc::frame, kFrames, "Frame at the beginning of which the blow strikes.");
  v.field("slot", &ImpactDesc::slot, {.required = true}, "The slot whose part is struck.");
  v.field("joint", &ImpactDesc::joint, {.may_be_empty = true},
          "Joint of that part, by its name in the part; the first joint if left out.");
  v.field("point_m", &ImpactDesc::point_m, {.low = -10, .high = 10}, "Struck point in the frame of that joint.");
  v.field("impulse_N_s", &ImpactDesc::impulse_N_s, {.low = -10000, .high = 10000},
          "Impulse along the axes of the character's start, N s.");
}

template <class V>
void fields(V& v, const DynamicsDesc*) {
  v.field("mode", &DynamicsDesc::mode, {.names = mode_names()}, "Mode of control.");
  v.field("ticks_per_frame", &DynamicsDesc::ticks_per_frame, {.low = 0, .high = 64},
          "Steps of control for each frame; 0 chooses the number that makes 120 steps a second.");
  v.field("loads", &DynamicsDesc::loads, {.max_count = 16},
          "Boxes whose mass the target motion does not take into account.");
  v.field("impacts", &DynamicsDesc::impacts, {.max_count = 64}, "Impacts that strike the character.");
}

template <class V>
void fields(V& v, const AttachmentDesc*) {
  v.field("object", &AttachmentDesc::object, {.required = true}, "An object of the character.");
  v.field("slot", &AttachmentDesc::slot, {.required = true}, "The slot whose part carries it.");
  v.field("socket", &AttachmentDesc::socket, {.required = true}, "A socket of that part.");
}

template <class V>
void fields(V& v, const CharacterChoice*) {
  v.field("name", &CharacterChoice::name, {.required = true}, "See `contort list characters`.");
  v.field("parts", &CharacterChoice::parts, {.max_count = 64},
          "Part for each slot that does not have its default part.");
  v.field("attachments", &CharacterChoice::attachments, {.max_count = 16}, "Objects that follow a socket.");
}

template <class V>
void fields(V& v, const RecordingDesc*) {
  v.field("name", &RecordingDesc::name, {.text = json_fields::Text::label, .required = true, .may_be_empty = true},
          "Name of an animation file in a library folder, without .glb, .gltf or .bvh.");
  v.field("clip", &RecordingDesc::clip, kOptionalLabel, "Clip of that animation; the first one if left out.");
  v.field("from_s", &RecordingDesc::from_s, {.low = 0, .high = 3600},
          "Time at which the recording begins; the part before it is left out.");
  v.field("joints", &RecordingDesc::joints,
          {.max_count = 1024, .text = json_fields::Text::label, .key_text = json_fields::Text::label},
          "Joint for each node whose name differs, as in contort.map/1.");
}

template <class V>
void fields(V& v, const Spec*) {
  v.constant("format", "contort.spec/1");
  v.field("character", &Spec::character, {.required = true}, "Character that moves.");
  v.field("rate_hz", &Spec::rate_hz, {.low = 1, .high = 1000}, "Frames per second.");
  v.field("hold_frames", &Spec::hold_frames, {.low = 0, .high = 6000}, "Frames after the last sequence.");
  v.field("environment", &Spec::environment, {}, "Ground and obstacles.");
  v.field("start", &Spec::start, {}, "Place where the character stands at first.");
  v.field("sequences", &Spec::sequences, {.max_count = 64}, "Sequences, which are played one after another.");
  v.field("interrupts", &Spec::interrupts, {.max_count = 64}, "Sequences that wait for a condition.");
  v.field("recording", &Spec::recording, {}, "An animation made elsewhere, instead of sequences.");
  v.field("dynamics", &Spec::dynamics, {}, "Mass, loads and impacts.");
  v.field("only_slot", &Spec::only_slot, {.may_be_empty = true}, "Moves this slot's part alone; all others stay.");
  v.field("only_sequence", &Spec::only_sequence, {.low = 0, .high = 128},
          "Plays this sequence alone, from the state that earlier ones leave; indices of interrupts follow those of "
          "the queue.");
  v.field("only_clip", &Spec::only_clip, {.low = 0, .high = 1000000}, "Plays this clip of that sequence alone.");
}

namespace json_fields {
extern template struct Codec<Spec>;  // compiled in spec.cpp
}

}  // namespace contort
