// The words of reports for the needs of a failure.
#include "renders/needs.h"

#include <gtest/gtest.h>


namespace contort {
namespace {

SequenceDesc sequence_of(std::initializer_list<const char*> actions) {
  SequenceDesc sequence;
  for (const char* action : actions) {
    ClipDesc clip;
    clip.actions.emplace_back();
    clip.actions.back().action = action;
    sequence.clips.push_back(clip);
  }
  return sequence;
}

TEST(Needs, OneActionNeedsNoMoreWords) {
  Spec spec;
  EXPECT_EQ(needs_of(spec), "no action");
  spec.sequences = {sequence_of({"hit_reaction"})};
  EXPECT_EQ(needs_of(spec), "hit_reaction");
}

TEST(Needs, ActionsAreNamedOnceClipsAndSequencesCounted) {
  Spec spec;
  spec.sequences = {sequence_of({"pose", "crouch"}), sequence_of({"pose"})};
  EXPECT_EQ(needs_of(spec), "crouch + pose, 3 clips, 2 sequences");
}

// The text must list everything that shrinking has left in the spec.
TEST(Needs, WhatASpecDoesNotHaveByItselfIsSaid) {
  const Spec base = [] {
    Spec spec;
    spec.sequences = {sequence_of({"walk"})};
    return spec;
  }();
  const auto with = [&](auto&& change) {
    Spec spec = base;
    change(spec);
    return needs_of(spec);
  };
  EXPECT_EQ(with([](Spec& s) { s.interrupts.resize(1), s.interrupts[0].sequence = sequence_of({"aim"}); }),
            "aim + walk, an interrupt");
  EXPECT_EQ(with([](Spec& s) { s.interrupts.resize(2); }), "walk, 2 interrupts");
  EXPECT_EQ(with([](Spec& s) { s.character.parts = {{"leg_left", "mech_leg_reverse"}}; }), "walk, mech_leg_reverse as leg_left");
  EXPECT_EQ(with([](Spec& s) { s.character.parts = {{"a", "x"}, {"b", "y"}, {"c", "z"}}; }), "walk, 3 swapped parts");
  EXPECT_EQ(with([](Spec& s) { s.character.attachments = {{"rifle", "arm_left", "grip"}}; }), "walk, rifle");
  EXPECT_EQ(with([](Spec& s) { s.dynamics.mode = Mode::dynamic, s.dynamics.impacts.resize(1); }), "walk, mode dynamic, a blow");
  EXPECT_EQ(with([](Spec& s) { s.dynamics.mode = Mode::tracking, s.dynamics.loads.resize(2); }), "walk, mode tracking, 2 loads");
  EXPECT_EQ(with([](Spec& s) { s.environment.ground = SlopeGround{}; }), "walk, a slope");
  EXPECT_EQ(with([](Spec& s) { s.environment.ground = StepsGround{}; }), "walk, steps");
  EXPECT_EQ(with([](Spec& s) { s.environment.ground = HeightGround{}; }), "walk, uneven ground");
  EXPECT_EQ(with([](Spec& s) { s.environment.obstacles.resize(1); }), "walk, an obstacle");
  EXPECT_EQ(with([](Spec& s) { s.rate_hz = 29.97; }), "walk, 29.97 frames a second");
}

TEST(Needs, ARecordingIsNamed) {
  Spec spec;
  spec.recording.name = "walk_01";
  EXPECT_EQ(needs_of(spec), "the recording walk_01");
}

}  // namespace
}  // namespace contort
