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
  v.field("start_frame", &ActionUse::start_frame, kFrames, "From the clip's start.");
  v.field("duration_frames", &ActionUse::duration_frames, kFrames, "A longer period plays slower.");
  v.field("speed", &ActionUse::speed, kSpeed, "Progress within the period.");
  v.field("blend_in_frames", &ActionUse::blend_in_frames, kBlendIn,
          "How long a course takes to come in; 0 is a cut, -1 as long as the way needs.");
  v.field("blend_out_frames", &ActionUse::blend_out_frames, kBlendOut, "How long it fades out before its end.");
  v.field("params", &ActionUse::params, {.max_count = 64}, "Parameters by the names that the action declares.");
}

template <class V>
void fields(V& v, const ClipDesc*) {
  v.field("name", &ClipDesc::name, kOptionalLabel, "For reports.");
  v.field("start_frame", &ClipDesc::start_frame, kFrames, "From the sequence's start.");
  v.field("duration_frames", &ClipDesc::duration_frames, kFrames, "0: natural length; else stretched to this.");
  v.field("speed", &ClipDesc::speed, kSpeed, "Divides the length.");
  v.field("actions", &ClipDesc::actions, {.max_count = 256}, "Actions that run in this clip.");
}

template <class V>
void fields(V& v, const SequenceDesc*) {
  v.field("name", &SequenceDesc::name, kOptionalLabel, "For reports.");
  v.field("duration_frames", &SequenceDesc::duration_frames, kFrames, "0: natural length; else stretched to this.");
  v.field("clips", &SequenceDesc::clips, {.max_count = 256}, "Clips on one time line.");
}

inline constexpr std::string_view kEnterNames[] = {"front", "after_clip", "after_sequence", "end"};

template <class V>
void fields(V& v, const ConditionDesc*) {
  v.field("event", &ConditionDesc::event, {.names = event_names(), .required = true}, "What it waits for.");
  v.field("frame", &ConditionDesc::frame, kFrames, "frame: of the motion.");
  v.field("name", &ConditionDesc::name, kOptionalLabel, "clip_ended, sequence_ended, near_obstacle: whose.");
  v.field("slot", &ConditionDesc::slot, {.may_be_empty = true}, "contact, aim_reached: of this slot's part.");
  v.field("distance_m", &ConditionDesc::distance_m, {.low = 0, .high = 1000}, "near_obstacle: from the root.");
  v.field("slope_deg", &ConditionDesc::slope_deg, {.low = 0, .high = 90}, "ground_steeper: under the root.");
}

template <class V>
void fields(V& v, const InterruptDesc*) {
  v.field("when", &InterruptDesc::when, {.required = true}, "Fires in the first frame in which this holds.");
  v.field("enter", &InterruptDesc::enter, {.names = kEnterNames}, "Its place in the queue.");
  v.field("after", &InterruptDesc::after, kOptionalLabel, "after_sequence: the name of that sequence.");
  v.field("resume", &InterruptDesc::resume, {}, "What it cuts goes on afterwards; else the rest is dropped.");
  v.field("sequence", &InterruptDesc::sequence, {.required = true}, "What enters.");
}

template <class V>
void fields(V& v, const StartDesc*) {
  v.field("position_m", &StartDesc::position_m, {.low = -1000, .high = 1000}, "On the ground, whatever its height.");
  v.field("heading_deg", &StartDesc::heading_deg, {.low = -360, .high = 360}, "0 faces +Z, 90 faces +X.");
  v.field("ahead_m", &StartDesc::ahead_m, {.low = -0.3, .high = 0.3}, "How far before the feet the hips stand and go.");
  v.field("lower_m", &StartDesc::lower_m, {.low = 0, .high = 0.3}, "How much lower than on stretched legs they stay.");
}

template <class V>
void fields(V& v, const LoadDesc*) {
  v.field("slot", &LoadDesc::slot, {.required = true}, "The slot whose part carries it.");
  v.field("socket", &LoadDesc::socket, {.required = true}, "A socket of that part.");
  v.field("position_m", &LoadDesc::position_m, {.low = -10, .high = 10}, "The box's centre, in the socket's frame.");
  v.field("size_m", &LoadDesc::size_m, {.low = 0.001, .high = 10}, "Along the socket's axes.");
  v.field("mass_kg", &LoadDesc::mass_kg, {.low = 0.001, .high = 10000}, "Spread evenly.");
}

template <class V>
void fields(V& v, const ImpactDesc*) {
  v.field("frame", &ImpactDesc::frame, kFrames, "Strikes before this frame moves on.");
  v.field("slot", &ImpactDesc::slot, {.required = true}, "The slot whose part is struck.");
  v.field("joint", &ImpactDesc::joint, {.may_be_empty = true},
          "Of that part, by its own name; its first one where left out.");
  v.field("point_m", &ImpactDesc::point_m, {.low = -10, .high = 10}, "In that joint's frame.");
  v.field("impulse_N_s", &ImpactDesc::impulse_N_s, {.low = -10000, .high = 10000}, "Along the axes of the start.");
}

template <class V>
void fields(V& v, const DynamicsDesc*) {
  v.field("mode", &DynamicsDesc::mode, {.names = mode_names()}, "How the motion is controlled.");
  v.field("ticks_per_frame", &DynamicsDesc::ticks_per_frame, {.low = 0, .high = 64},
          "Of control; 0: as many as make 120 a second.");
  v.field("loads", &DynamicsDesc::loads, {.max_count = 16}, "Boxes that the target motion does not know of.");
  v.field("impacts", &DynamicsDesc::impacts, {.max_count = 64}, "Blows.");
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
  v.field("parts", &CharacterChoice::parts, {.max_count = 64}, "Slot to part, where it is not the default.");
  v.field("attachments", &CharacterChoice::attachments, {.max_count = 16}, "Objects that follow a socket.");
}

template <class V>
void fields(V& v, const RecordingDesc*) {
  v.field("name", &RecordingDesc::name, {.text = json_fields::Text::label, .required = true, .may_be_empty = true},
          "An animation of a library folder, without .glb, .gltf or .bvh.");
  v.field("clip", &RecordingDesc::clip, kOptionalLabel, "One of its clips; the first where left out.");
  v.field("from_s", &RecordingDesc::from_s, {.low = 0, .high = 3600}, "Leaves out what comes before.");
  v.field("joints", &RecordingDesc::joints,
          {.max_count = 1024, .text = json_fields::Text::label, .key_text = json_fields::Text::label},
          "Node to joint, where names differ, as in a contort.map/1.");
}

template <class V>
void fields(V& v, const Spec*) {
  v.constant("format", "contort.spec/1");
  v.field("character", &Spec::character, {.required = true}, "Who moves.");
  v.field("rate_hz", &Spec::rate_hz, {.low = 1, .high = 1000}, "Frames per second.");
  v.field("hold_frames", &Spec::hold_frames, {.low = 0, .high = 6000}, "Frames after the last sequence.");
  v.field("environment", &Spec::environment, {}, "Ground and obstacles.");
  v.field("start", &Spec::start, {}, "Where the character stands at first.");
  v.field("sequences", &Spec::sequences, {.max_count = 64}, "Played one after another.");
  v.field("interrupts", &Spec::interrupts, {.max_count = 64}, "Sequences that wait for a condition.");
  v.field("recording", &Spec::recording, {}, "An animation made elsewhere, instead of sequences.");
  v.field("dynamics", &Spec::dynamics, {}, "Mass, loads and impacts.");
  v.field("only_slot", &Spec::only_slot, {.may_be_empty = true}, "Moves this slot's part alone; all others stay.");
  v.field("only_sequence", &Spec::only_sequence, {.low = 0, .high = 128},
          "Plays this sequence alone, from the state that those before it leave; interrupts' count after the queue's.");
  v.field("only_clip", &Spec::only_clip, {.low = 0, .high = 1000000}, "Plays this clip of that sequence alone.");
}

namespace json_fields {
extern template struct Codec<Spec>;  // compiled in spec.cpp
}

}  // namespace contort
