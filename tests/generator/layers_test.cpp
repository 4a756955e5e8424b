// The tables "Priorities" and "Blending" of docs/reference/timeline.md, a test for each cell.
#include <gtest/gtest.h>

#include <cmath>

#include "generator/generate.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::coord;
using fixtures::elbow;
using fixtures::human;
using fixtures::sequence;
using fixtures::stage_of;
using fixtures::use;

constexpr double kDegree = kRadPerDeg;
const char* const kLayeredElbow = "arm_left/elbow";
const Vec3 kTarget_m(0.3, 1.2, 0.35);

ActionUse reach(int start, int duration) {
  return use("reach", "arm_left", start, duration, {{"target_m", kTarget_m}});
}
ActionUse nudge(int start, int duration, double strength_deg) {
  return use("hit_reaction", "arm_left", start, duration, {{"strength_deg", strength_deg}});
}

Motion play(std::vector<ActionUse> actions, int hold = 0) {
  return generate(stage_of({sequence(std::move(actions))}, hold));
}
double elbow_at(const Motion& motion, int frame) { return coord(motion, frame, human(), kLayeredElbow); }

// The distance of the wrist from where `reach` should bring it.
double miss_m(const Motion& motion, int frame) {
  std::vector<Rigid> world(human().joints().size());
  forward_kinematics(human(), motion.root[static_cast<std::size_t>(frame)], motion.row(frame), world);
  return length(world_from_socket(human(), world, human().find_socket("arm_left/wrist")).p_m - kTarget_m);
}

// The largest difference of any coordinate between two motions in one frame.
double difference(const Motion& a, const Motion& b, int frame) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.row(frame).size(); ++i)
    most = std::max(most, std::fabs(a.row(frame)[i] - b.row(frame)[i]));
  return most;
}

// The largest step of the elbow between two frames.
double largest_step(const Motion& motion, int first = 1) {
  double most = 0.0;
  for (int f = first; f < motion.frame_count; ++f)
    most = std::max(most, std::fabs(elbow_at(motion, f) - elbow_at(motion, f - 1)));
  return most;
}

TEST(Layers, OverwriteIsReplacedByOverwriteForGood) {
  const Motion motion = play({elbow(0, 60, 90), elbow(10, 20, 20)});
  EXPECT_EQ(elbow_at(motion, 30), 20 * kDegree);
  EXPECT_EQ(elbow_at(motion, 60), 20 * kDegree);
  EXPECT_LT(largest_step(motion), 5 * kDegree);
}

TEST(Layers, IkIsSeenOverOverwriteWhichGoesOnBeneath) {
  const Motion motion = play({elbow(0, 60, 90), reach(10, 20)});
  EXPECT_LT(miss_m(motion, 30), 1e-9);
  EXPECT_EQ(elbow_at(motion, 60), 90 * kDegree);  // from the posture that was reached, in the time that was left
  EXPECT_LT(largest_step(motion), 8 * kDegree);
}

TEST(Layers, IkIsSeenOverOverwriteThatStartsLater) {
  const Motion motion = play({reach(0, 40), elbow(10, 60, 90)});
  EXPECT_LT(miss_m(motion, 40), 1e-9);
  EXPECT_EQ(elbow_at(motion, 70), 90 * kDegree);
  EXPECT_LT(largest_step(motion), 8 * kDegree);
}

TEST(Layers, IkIsReplacedByIkForGood) {
  const ActionUse other = use("reach", "arm_left", 10, 20, {{"target_m", Vec3(0.5, 1.0, 0.1)}});
  const Motion motion = play({reach(0, 60), other});
  const Motion alone = play({other}, 30);
  EXPECT_GT(miss_m(motion, 60), 0.1);
  EXPECT_EQ(elbow_at(motion, 60), elbow_at(motion, 30));
  EXPECT_NEAR(elbow_at(motion, 60), elbow_at(alone, 60), 1e-9);
}

TEST(Layers, AnIkThatEndsAloneIsHeld) {
  const Motion motion = play({reach(0, 20)}, 30);
  EXPECT_EQ(difference(motion, motion, 20), 0.0);
  for (int f = 20; f <= 50; ++f) EXPECT_LT(miss_m(motion, f), 1e-9) << f;
}

TEST(Layers, AnIkThatFadedOutLeavesTheBase) {
  ActionUse fading = reach(10, 40);
  fading.blend_out_frames = 15;
  fading.speed = 2;
  const Motion with = play({elbow(0, 10, 60), fading}, 20);
  const Motion without = play({elbow(0, 10, 60)}, 60);
  EXPECT_LT(miss_m(with, 34), 1e-9);
  for (int f = 50; f < with.frame_count; ++f) EXPECT_EQ(difference(with, without, f), 0.0) << f;
  const double faded = std::fabs(elbow_at(with, 34) - 60 * kDegree);
  EXPECT_LE(largest_step(with, 35), 1.875 / 15 * faded) << "steeper than the minimum-jerk curve";
}

TEST(Layers, AnIkThatFadedOutShowsTheOverwriteThatWentOnBeneath) {
  ActionUse fading = reach(10, 40);
  fading.blend_out_frames = 15;
  const Motion with = play({elbow(0, 100, 60), fading});
  const Motion without = play({elbow(0, 100, 60)});
  for (int f = 51; f <= 100; ++f) EXPECT_NEAR(elbow_at(with, f), elbow_at(without, f), 1e-12) << f;
}

TEST(Layers, AnAdditiveAddsOnWhateverIsBeneathAndLeavesNothing) {
  const std::vector<std::vector<ActionUse>> beneath = {
      {elbow(0, 60, 90)}, {reach(0, 60)}, {elbow(0, 60, 90), reach(5, 40)}, {elbow(0, 10, 30)}};
  for (const std::vector<ActionUse>& actions : beneath) {
    std::vector<ActionUse> added = actions;
    added.push_back(nudge(15, 20, 30));
    const Motion with = play(added, 60);
    const Motion without = play(actions, 60);
    double most = 0.0;
    for (int f = 0; f < std::min(with.frame_count, without.frame_count); ++f) {
      if (f <= 15 || f >= 35) {
        EXPECT_EQ(difference(with, without, f), 0.0) << f;
      } else {
        most = std::max(most, difference(with, without, f));
      }
    }
    EXPECT_GT(most, 1 * kDegree) << "the additive did nothing";
  }
}

TEST(Layers, ActionsThatStartUnderAnAdditiveStartFromThePostureWithoutIt) {
  for (const ActionUse& later : {elbow(20, 30, 90), reach(20, 30)}) {
    const Motion with = play({nudge(10, 20, 30), later});
    const Motion without = play({later});
    for (int f = 30; f <= 50; ++f) EXPECT_EQ(difference(with, without, f), 0.0) << f;
  }
}

TEST(Layers, AdditivesAddUp) {
  const Motion one = play({nudge(0, 30, 10)});
  const Motion two = play({nudge(0, 30, 10), nudge(0, 30, 10)});
  for (int f = 1; f < 30; ++f) EXPECT_NEAR(elbow_at(two, f), 2 * elbow_at(one, f), 1e-12) << f;
}

TEST(Layers, ThreeOnOnePartAreAllThereAtOnce) {
  const Motion all = play({elbow(0, 40, 90), reach(5, 30), nudge(10, 20, 20)}, 20);
  const Motion two = play({elbow(0, 40, 90), reach(5, 30)}, 20);
  const Motion last = play({elbow(0, 40, 90)}, 20);
  EXPECT_GT(difference(all, two, 20), 1 * kDegree);
  EXPECT_EQ(difference(all, two, 30), 0.0);
  EXPECT_LT(miss_m(all, 35), 1e-9);
  EXPECT_EQ(elbow_at(all, 60), elbow_at(last, 60));
}

TEST(Layers, ActionsWithoutLengthAreThereOneFrameAfterTheirStart) {
  const Motion pose = play({elbow(5, 0, 90)}, 3);
  EXPECT_EQ(elbow_at(pose, 5), 0.0);
  EXPECT_EQ(elbow_at(pose, 6), 90 * kDegree);
  EXPECT_EQ(elbow_at(pose, 9), 90 * kDegree);
  const Motion ik = play({reach(5, 0)}, 3);
  EXPECT_EQ(elbow_at(ik, 5), 0.0);
  EXPECT_LT(miss_m(ik, 6), 1e-9);
  EXPECT_LT(miss_m(ik, 9), 1e-9);
  const Motion additive = play({nudge(5, 0, 30)}, 5);
  for (int f = 0; f < additive.frame_count; ++f) EXPECT_EQ(elbow_at(additive, f), 0.0) << f;
}

TEST(Layers, OfTwoThatStartInOneFrameTheLaterInTheSpecWins) {
  EXPECT_EQ(elbow_at(play({elbow(0, 20, 90), elbow(0, 20, 30)}), 20), 30 * kDegree);
  EXPECT_EQ(elbow_at(play({elbow(0, 20, 30), elbow(0, 20, 90)}), 20), 90 * kDegree);
}

// Half a turn and more between two postures of a ball joint: the shorter way, at an even axis, without a flip.
TEST(Blending, BallsTakeTheShorterArc) {
  const auto shoulder = [](int start, double z_deg) {
    return use("pose", "arm_left", start, 40, {{"shoulder_deg", Vec3(0, 0, z_deg)}});
  };
  const Motion motion = play({shoulder(0, 170), shoulder(40, -170)});
  const Joint& joint = fixtures::joint(human(), "arm_left/shoulder");
  for (int f = 41; f <= 80; ++f) {
    const double* q = motion.row(f).data() + joint.coord;
    const double angle = rotation_angle(Quat(q[0], q[1], q[2], q[3]));
    EXPECT_GE(angle, 170 * kDegree - 1e-12) << f;  // through 180, not back through 0
  }
}

TEST(Blending, WhatDoesNotFitTheKindOfActionIsRefused) {
  Spec spec;
  spec.sequences = {sequence({elbow(0, 30, 90)})};
  spec.sequences[0].clips[0].actions[0].blend_in_frames = 3;
  const Result<Stage> in = build_stage(spec, stock_library());
  ASSERT_FALSE(in.ok());
  EXPECT_EQ(in.issue().code, "spec.bad_blend");
  EXPECT_EQ(in.issue().pointer, "/sequences/0/clips/0/actions/0/blend_in_frames");
  spec.sequences[0].clips[0].actions[0].blend_in_frames = 0;
  spec.sequences[0].clips[0].actions[0].blend_out_frames = 3;
  EXPECT_EQ(build_stage(spec, stock_library()).issue().pointer, "/sequences/0/clips/0/actions/0/blend_out_frames");
}

InterruptDesc interrupt(int frame, std::vector<ActionUse> actions) {
  InterruptDesc made;
  made.when.frame = frame;
  made.sequence = sequence(std::move(actions));
  return made;
}

Motion play_interrupted(std::vector<ActionUse> actions, const InterruptDesc& by) {
  Spec spec;
  spec.sequences = {sequence(std::move(actions))};
  spec.interrupts = {by};
  const Result<Stage> stage = build_stage(spec, stock_library());
  EXPECT_TRUE(stage.ok()) << (stage.ok() ? "" : to_line(stage.issue()));
  return generate(*stage);
}

TEST(Interrupts, CutWhatRunsAndItGoesOnFromWhereItStood) {
  const Motion motion = play_interrupted({elbow(0, 40, 90)}, interrupt(20, {elbow(0, 10, 10)}));
  EXPECT_EQ(motion.frame_count, 51);
  EXPECT_EQ(motion.queue, (std::vector<QueueSpan>{{0, 20, 0, 0}, {20, 30, 1, 0}, {30, 50, 0, 20}}));
  EXPECT_NEAR(elbow_at(motion, 20), 45 * kDegree, 1e-12);
  EXPECT_EQ(elbow_at(motion, 30), 10 * kDegree);
  EXPECT_EQ(elbow_at(motion, 50), 90 * kDegree);
  EXPECT_LT(largest_step(motion), 10 * kDegree);
}

TEST(Interrupts, DropTheRestIfTheyAreToldTo) {
  InterruptDesc by = interrupt(20, {elbow(0, 10, 10)});
  by.resume = false;
  const Motion motion = play_interrupted({elbow(0, 40, 90)}, by);
  EXPECT_EQ(motion.frame_count, 31);
  EXPECT_EQ(elbow_at(motion, 30), 10 * kDegree);
}

// A blow on the torso, cut at its height: 40 degrees that would vanish in one frame. Nothing must remain at the end.
TEST(Interrupts, LetAnAdditiveFadeThatTheyCut) {
  const std::vector<ActionUse> blow = {
      use("hit_reaction", "torso", 0, 60, {{"strength_deg", 40.0}, {"azimuth_deg", 0.0}})};
  for (const bool resume : {false, true}) {
    InterruptDesc by = interrupt(10, {elbow(0, 30, 50)});
    by.resume = resume;
    const Motion cut = play_interrupted(blow, by);
    double least = 0.0, fastest = 0.0, last = 0.0;
    for (int f = 0; f < cut.frame_count; ++f) {
      const double now = coord(cut, f, human(), "torso/lumbar_flex");
      fastest = std::max(fastest, std::fabs(now - last));
      least = std::min(least, now), last = now;
    }
    EXPECT_LT(least, -8 * kDegree) << resume;   // it was in full swing
    EXPECT_LT(fastest, 4 * kDegree) << resume;  // 2.8; it was 12.6 when it was gone at once
    EXPECT_NEAR(last, 0.0, 1e-9) << resume;     // and leaves no offset
  }
}

// An action that fades out normally hands nothing over at its end. Here it has not faded: the head was back at rest one
// frame after the cut.
TEST(Interrupts, HoldACourseThatFadesOutWhereTheyCutIt) {
  ActionUse look = use("look_at", "head", 0, 60, {{"target_m", Vec3(1.0, 1.5, 2.0)}});
  look.blend_in_frames = look.blend_out_frames = 20;
  for (const int frame : {30, 50}) {  // without fading, and while it fades
    InterruptDesc by = interrupt(frame, {elbow(0, 30, 50)});
    by.resume = false;
    const Motion cut = play_interrupted({look}, by);
    const double held = coord(cut, frame, human(), "head/neck_rot");
    EXPECT_GT(std::fabs(held), 10 * kDegree) << frame;
    for (int f = frame; f < cut.frame_count; ++f) ASSERT_EQ(coord(cut, f, human(), "head/neck_rot"), held) << f;
  }
}

// The greatest turn of a hip or knee from one frame to the next. The walk is cut in the middle of a stride; it would
// continue with both feet at home, and would be there at once.
double fastest_of_legs(const Motion& motion) {
  double fastest = 0.0;
  for (int f = 1; f < motion.frame_count; ++f)
    for (const char* joint : {"leg_left/hip_flex", "leg_right/hip_flex", "leg_left/knee", "leg_right/knee"})
      fastest = std::max(fastest, std::fabs(coord(motion, f, human(), joint) - coord(motion, f - 1, human(), joint)));
  return fastest;
}

TEST(Interrupts, LetAWalkComeInAgainAsGentlyAsOneThatNobodyCuts) {
  const ActionUse walk = use("walk", "waist", 0, 150, {{"speed_m_s", 0.9}});
  const Motion cut = play_interrupted({walk}, interrupt(40, {elbow(0, 20, 50)}));
  EXPECT_LE(fastest_of_legs(cut), fastest_of_legs(play({walk})));  // 43 degrees when it was at once
}

TEST(Interrupts, ThatNeverFireChangeNothing) {
  const Motion with = play_interrupted({elbow(0, 40, 90)}, interrupt(400, {elbow(0, 10, 10)}));
  EXPECT_EQ(motion_hash(with), motion_hash(play({elbow(0, 40, 90)})));
}

TEST(Interrupts, NamesThatNobodyHasAreRefused) {
  Spec spec;
  spec.interrupts = {interrupt(5, {elbow(0, 10, 10)})};
  spec.interrupts[0].when.event = Event::clip_ended;
  spec.interrupts[0].when.name = "nobody";
  EXPECT_EQ(build_stage(spec, stock_library()).issue().pointer, "/interrupts/0/when/name");
  spec.interrupts[0].when.event = Event::contact;
  EXPECT_EQ(build_stage(spec, stock_library()).issue().pointer, "/interrupts/0/when/slot");
  spec.interrupts[0].when.event = Event::frame;
  spec.interrupts[0].sequence.clips[0].actions[0].slot = "tail";
  EXPECT_EQ(build_stage(spec, stock_library()).issue().pointer, "/interrupts/0/sequence/clips/0/actions/0/slot");
}

}  // namespace
}  // namespace contort
