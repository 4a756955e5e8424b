// The circumstances of a frame: one example for each phase.
#include "checks/circumstances.h"

#include "generator/execute.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

struct Case {
  Stage stage;
  Motion motion;
  explicit Case(const Spec& spec) : stage(*build_stage(spec, stock_library())), motion(generate(stage)) {}
  Circumstances at(int frame) const { return circumstances_of(intent_of(stage), *stage.character, motion, frame); }
  Phase phase(int frame) const { return at(frame).phase; }
};

// Elbow for 40 frames, then, in a second clip, the knee for 40.
Spec two_clips() {
  Spec spec;
  spec.hold_frames = 30;
  spec.sequences = {sequence({use("pose", "arm_left", 0, 40, {{"elbow_deg", 40.0}})})};
  ClipDesc second;
  second.start_frame = 40;
  second.actions = {use("pose", "leg_left", 0, 40, {{"knee_deg", 40.0}})};
  spec.sequences[0].clips.push_back(second);
  return spec;
}

TEST(Circumstances, TheMiddleOfAClipIsCalledSoWithItsActions) {
  const Case c(two_clips());
  EXPECT_EQ(c.at(20), (Circumstances{Phase::mid_clip, {{"pose", "arm_left", "/sequences/0/clips/0/actions/0"}}}));
  EXPECT_EQ(c.at(60), (Circumstances{Phase::mid_clip, {{"pose", "leg_left", "/sequences/0/clips/1/actions/0"}}}));
}

TEST(Circumstances, WhereAClipBeginsItIsASwitch) {
  const Case c(two_clips());
  EXPECT_EQ(c.phase(0), Phase::mid_clip);  // there is no earlier action
  EXPECT_EQ(c.phase(38), Phase::mid_clip);
  for (const int frame : {39, 40, 41}) EXPECT_EQ(c.phase(frame), Phase::clip_switch) << frame;
  EXPECT_EQ(c.phase(42), Phase::mid_clip);
}

TEST(Circumstances, WhereASequenceBeginsItIsASwitch) {
  Spec spec = two_clips();
  spec.sequences.push_back(sequence({use("pose", "arm_left", 0, 40, {{"elbow_deg", 10.0}})}));
  const Case c(spec);
  for (const int frame : {79, 80, 81}) EXPECT_EQ(c.phase(frame), Phase::clip_switch) << frame;
  EXPECT_EQ(c.at(90).actions[0].pointer, "/sequences/1/clips/0/actions/0");
}

TEST(Circumstances, AfterTheEndTheFigureIsAtRest) { EXPECT_EQ(Case(two_clips()).at(100), Circumstances{}); }

TEST(Circumstances, WhatComesInOrFadesOutBlends) {
  Spec spec = two_clips();
  ActionUse& second = spec.sequences[0].clips[1].actions[0];
  second = use("look_at", "head", 0, 40, {{"target_m", Vec3(1, 1.5, 2)}});
  second.blend_in_frames = 8, second.blend_out_frames = 8;
  const Case c(spec);
  EXPECT_EQ(c.phase(45), Phase::blend);
  EXPECT_EQ(c.phase(60), Phase::mid_clip);
  EXPECT_EQ(c.phase(75), Phase::blend);
}

TEST(Circumstances, AnInterruptIsOneWhereItEntersAndWhereItHandsBack) {
  Spec spec = two_clips();
  InterruptDesc interrupt;
  interrupt.when.event = Event::frame, interrupt.when.frame = 20;
  interrupt.sequence = sequence({use("pose", "arm_right", 0, 30, {{"elbow_deg", 40.0}})});
  spec.interrupts = {interrupt};
  const Case c(spec);
  ASSERT_EQ(c.motion.queue.size(), 3U);
  const int enters = c.motion.queue[1].first_frame, back = c.motion.queue[2].first_frame;
  EXPECT_EQ(c.phase(enters + 5), Phase::interrupt);
  EXPECT_EQ(c.phase(enters + 15), Phase::mid_clip);
  EXPECT_EQ(c.at(enters + 15).actions[0],
            (ActiveAction{"pose", "arm_right", "/interrupts/0/sequence/clips/0/actions/0"}));
  EXPECT_EQ(c.phase(back + 5), Phase::interrupt);
}

TEST(Circumstances, ABlowIsFeltForHalfASecond) {
  Spec spec = two_clips();
  spec.dynamics.mode = Mode::tracking;
  spec.dynamics.impacts = {{10, "torso", "", {}, {0, 0, -2}}};
  const Case c(spec);
  EXPECT_EQ(c.phase(9), Phase::mid_clip);
  EXPECT_EQ(c.phase(10), Phase::impact);
  EXPECT_EQ(c.phase(40), Phase::impact);
  EXPECT_EQ(c.phase(42), Phase::mid_clip);
}

}  // namespace
}  // namespace contort
