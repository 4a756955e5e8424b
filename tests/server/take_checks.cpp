// Commands of a client as edits of specs, and the parts that they may not change.
#include "server/take.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "generator/generate.h"
#include "server/session.h"

namespace contort::server {
namespace {

SequenceDesc one(const std::string& action, const std::string& slot, int frames) {
  SequenceDesc sequence;
  ActionUse use;
  use.action = action, use.slot = slot, use.duration_frames = frames;
  sequence.clips.push_back({"", 0, 0, 1.0, {use}});
  return sequence;
}

Spec walking() {
  Spec spec;
  spec.character.name = "mech", spec.rate_hz = 30;
  spec.sequences = {one("walk", "waist", 90)};
  spec.hold_frames = 60;
  return spec;
}

Motion motion_of(const Spec& spec) {
  const Result<Stage> stage = build_stage(spec, stock_library());
  EXPECT_TRUE(stage) << to_line(stage.issue());
  return stage ? generate(*stage) : Motion{};
}

AimCommand at(const std::string& slot, const Vec3& target_m) {
  AimCommand aim;
  aim.slot = slot, aim.action = "look_at", aim.target_m = target_m;
  return aim;
}

// Draws a command that a terminal may give at a moment.
Result<Spec> draw_command(const Spec& spec, const Moment& now) {
  switch (*rc::gen::inRange(0, 4)) {
    case 0: return with_sequence(spec, one("crouch", "waist", *rc::gen::inRange(20, 60)), Enter::end, true, now);
    case 1: return with_sequence(spec, one("pose", "arm_left", *rc::gen::inRange(5, 40)), Enter::front, *rc::gen::arbitrary<bool>(), now);
    case 2: return with_aim(spec, at("head", Vec3(*rc::gen::inRange(-3, 4), 1.5, *rc::gen::inRange(1, 6))), now);
    default: {
      PushCommand push;
      push.slot = "torso", push.impulse_N_s = Vec3(*rc::gen::inRange(-200, 200), 0, *rc::gen::inRange(-200, 200));
      return with_push(spec, push, now);
    }
  }
}

RC_GTEST_PROP(Take, ACommandChangesNoFrameThatWasShownOfAKinematicMotion, ()) {
  Spec spec = walking();
  int frame = 0;
  for (int command = 0; command < 4; ++command) {
    const Motion before = motion_of(spec);
    frame = *rc::gen::inRange(frame, std::min(frame + 40, before.frame_count));
    const Result<Spec> next = draw_command(spec, {frame, before.queue});
    RC_ASSERT(next.ok());
    const Motion after = motion_of(*next);
    RC_ASSERT(after.frame_count > frame);
    for (int f = 0; f <= frame; ++f) {
      RC_ASSERT(before.root[static_cast<std::size_t>(f)] == after.root[static_cast<std::size_t>(f)]);
      RC_ASSERT(std::ranges::equal(before.row(f), after.row(f)));
    }
    spec = *next;
  }
}

TEST(Take, AimingJoinsTheSequenceThatRuns) {
  const Motion motion = motion_of(walking());
  const Result<Spec> spec = with_aim(walking(), at("head", Vec3(1, 1.5, 4)), {30, motion.queue});
  ASSERT_TRUE(spec);
  EXPECT_TRUE(spec->interrupts.empty());
  ASSERT_EQ(spec->sequences[0].clips.size(), 2u);
  EXPECT_EQ(spec->sequences[0].clips[1].start_frame, 31);
  const Motion aimed = motion_of(*spec);
  const auto looks = [](const ActionSpan& span) { return span.clip == 1 && span.first_frame == 31; };
  EXPECT_TRUE(std::ranges::any_of(aimed.spans, looks));
  EXPECT_EQ(aimed.root[80].p_m.z, motion.root[80].p_m.z) << "the walk goes on";
}

TEST(Take, AimingAloneWaitsForTheNextFrameWhereNothingRuns) {
  const Motion motion = motion_of(walking());
  const Result<Spec> spec = with_aim(walking(), at("head", Vec3(1, 1.5, 4)), {120, motion.queue});
  ASSERT_TRUE(spec);
  ASSERT_EQ(spec->interrupts.size(), 1u);
  EXPECT_EQ(spec->interrupts[0].when.frame, 121);
  EXPECT_EQ(motion_of(*spec).spans.back().first_frame, 121);
}

TEST(Take, WorldPlacesAndImpulsesAreTurnedIntoTheStart) {
  Spec spec = walking();
  spec.start.heading_deg = 90, spec.start.position_m = Vec3(2, 0, 3);
  PushCommand push;
  push.slot = "torso", push.impulse_N_s = Vec3(10, 0, 0);  // along the way it faces
  const Result<Spec> pushed = with_push(spec, push, {0, {}});
  ASSERT_TRUE(pushed);
  EXPECT_NEAR(pushed->dynamics.impacts[0].impulse_N_s.z, 10.0, 1e-12);
  EXPECT_NEAR(pushed->dynamics.impacts[0].impulse_N_s.x, 0.0, 1e-12);
  const Result<Spec> aimed = with_aim(spec, at("head", Vec3(7, 1.5, 3)), {0, {}});
  ASSERT_TRUE(aimed);
  const auto target = std::get<Vec3>(aimed->interrupts[0].sequence.clips[0].actions[0].params.at("target_m"));
  EXPECT_NEAR(target.z, 5.0, 1e-12) << "five metres ahead";
  EXPECT_NEAR(target.x, 0.0, 1e-12);
}

TEST(Take, IsFullAtTheLimitsOfASpec) {
  Spec spec = walking();
  for (int i = 0; i < 64; ++i) spec = *with_sequence(spec, one("pose", "head", 1), Enter::end, true, {0, {}});
  EXPECT_EQ(with_sequence(spec, one("pose", "head", 1), Enter::end, true, {0, {}}).issue().code, "take.full");
  EXPECT_EQ(with_aim(spec, at("head", Vec3(0, 1, 1)), {0, {}}).issue().code, "take.full");
  for (int i = 0; i < 64; ++i) spec = *with_push(spec, {"torso", "", Vec3(0), Vec3(1, 0, 0)}, {0, {}});
  EXPECT_EQ(with_push(spec, {"torso", "", Vec3(0), Vec3(1, 0, 0)}, {0, {}}).issue().code, "take.full");
  EXPECT_TRUE(parse_spec(print_spec(spec))) << "and such a spec is one";
}

TEST(Take, TheNextOneBeginsWhereTheFigureStandsAndFaces) {
  const Result<Character> character = build_character(walking().character, stock_library());
  ASSERT_TRUE(character);
  const Quat turn = axis_angle(Vec3(0, 1, 0), -30 * kRadPerDeg);
  const Spec next = next_take(walking(), {turn * character->rest_root().q, Vec3(1.23449, 0.8, -2)},
                              character->rest_root().q);
  EXPECT_EQ(next.start.position_m, Vec3(1.234, 0, -2));
  EXPECT_EQ(next.start.heading_deg, -30.0);
  EXPECT_TRUE(next.sequences.empty());
  EXPECT_EQ(next.character, walking().character);
}

TEST(PlayClock, CountsFramesOfTheTimeThatGoesBy) {
  PlayClock clock;
  const Time begin{};
  EXPECT_EQ(clock.frame(30, begin + std::chrono::seconds(5)), 0) << "it does not play";
  clock.set(10, true, begin);
  EXPECT_EQ(clock.frame(30, begin), 10);
  EXPECT_EQ(clock.frame(30, begin + std::chrono::milliseconds(34)), 11);
  EXPECT_EQ(clock.frame(30, begin + std::chrono::seconds(2)), 70);
  clock.set(7, false, begin);
  EXPECT_EQ(clock.frame(30, begin + std::chrono::seconds(9)), 7);
}

}  // namespace
}  // namespace contort::server
