// The parts of a spec that a profile would not have drawn, and shrinking within the profile.
#include "fuzz/profile_violations.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "fuzz/draw.h"
#include "fuzz/shrink.h"
#include "generator/generate.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

Profile profile_of(const std::string& text) { return parse_profile(text).value(); }

// The built-in profiles, and those for planted faults.
std::vector<Profile> known_profiles() {
  std::vector<Profile> all = {Profile{}};
  for (const Profile& profile : built_in_profiles()) all.push_back(profile);
  for (const auto& entry : fs::directory_iterator(CONTORT_SOURCE_DIR "/bench/mutants/profiles"))
    all.push_back(load_profile(entry.path().string()).value());
  return all;
}

TEST(ProfileViolations, ADrawnSpecHasNone) {
  for (const Profile& profile : known_profiles()) {
    DrawConfig draw{profile.characters, profile};
    if (draw.characters.empty()) draw.characters = {"human", "mech", "quadruped"};
    ASSERT_TRUE(validate(profile, draw.characters, stock_generator()).ok()) << profile.name;
    for (int i = 0; i < 60; ++i) {
      const Spec spec = draw_spec(draw, stock_generator(), 5, i);
      ASSERT_EQ(profile_violations(spec, profile, stock_generator()), 0) << profile.name << pretty_spec(spec);
    }
  }
}

ActionUse use_of(const char* action, const char* slot) {
  ActionUse use;
  use.action = action, use.slot = slot;
  return use;
}

Spec spec_of_one(const ActionUse& use) {
  Spec spec;
  spec.sequences.resize(1);
  spec.sequences[0].clips.resize(1);
  spec.sequences[0].clips[0].actions = {use};
  return spec;
}

const Profile kSlow = [] {
  return profile_of(R"({"format": "contort.profile/1", "name": "slow", "speeds": false, "overlaps": false,
    "shortest_frames": 30, "longest_frames": 60, "actions": ["walk", "look_at", "pose"], "slots": ["waist", "head"],
    "rules": [{"param": "blend_in_frames", "low": [20], "high": [30]}, {"actions": ["pose"], "never": true, "slots": ["waist"]},
              {"actions": ["walk"], "param": "speed_m_s", "low": [0.3], "high": [0.8]},
              {"actions": ["look_at"], "param": "target_m", "low": [-1, 0, 2], "high": [1, 2, 5]}]})");
}();

ActionUse slow_walk() {
  ActionUse walk = use_of("walk", "waist");
  walk.blend_in_frames = 20, walk.params["speed_m_s"] = 0.5;
  return walk;
}

int profile_violations_of(const Spec& spec) { return profile_violations(spec, kSlow, stock_generator()); }

TEST(ProfileViolations, EachIsCounted) {
  ASSERT_EQ(profile_violations_of(spec_of_one(slow_walk())), 0);
  const auto walk = [](auto&& change) {
    ActionUse use = slow_walk();
    change(use);
    return profile_violations_of(spec_of_one(use));
  };
  EXPECT_EQ(walk([](ActionUse& use) { use.blend_in_frames = 19; }), 1);
  EXPECT_EQ(walk([](ActionUse& use) { use.blend_out_frames = 5; }), 0) << "no rule speaks of it";
  EXPECT_EQ(walk([](ActionUse& use) { use.duration_frames = 29; }), 1);
  EXPECT_EQ(walk([](ActionUse& use) { use.duration_frames = 61; }), 1);
  EXPECT_EQ(walk([](ActionUse& use) { use.speed = 1.5; }), 1);
  EXPECT_EQ(walk([](ActionUse& use) { use.params["speed_m_s"] = 0.9; }), 1);
  EXPECT_EQ(walk([](ActionUse& use) { use.params.erase("speed_m_s"); }), 1) << "it is 1.2 m/s without";
  EXPECT_EQ(walk([](ActionUse& use) { use.action = "squat"; }), 1);
}

// Shrinking turned arms by fewer degrees about fewer axes, and so into the trunk.
TEST(ProfileViolations, PosesThatPutBodiesIntoEachOtherAreCountedUnlessTheProfileDrawsThem) {
  ActionUse into_trunk = use_of("pose", "arm_left"), raised = use_of("pose", "arm_left");
  into_trunk.params["shoulder_deg"] = Vec3(0.0, 0.0, -11.0), raised.params["shoulder_deg"] = Vec3(0.0, 0.0, 40.0);
  const Profile usual = profile_of(R"({"format": "contort.profile/1", "name": "usual"})");
  const Profile wild = profile_of(R"({"format": "contort.profile/1", "name": "wild", "wild_poses": true})");
  EXPECT_EQ(profile_violations(spec_of_one(into_trunk), usual, stock_generator()), 1);
  EXPECT_EQ(profile_violations(spec_of_one(into_trunk), wild, stock_generator()), 0);
  EXPECT_EQ(profile_violations(spec_of_one(raised), usual, stock_generator()), 0);
}

TEST(ProfileViolations, VectorsAreHeldAgainstEachLimit) {
  ActionUse look = use_of("look_at", "head");
  look.blend_in_frames = 25;
  for (const auto& [target, count] : {std::pair(Vec3(0, 1, 3), 0), std::pair(Vec3(0, 3, 3), 1), std::pair(Vec3(0, 1, 1), 1)}) {
    look.params["target_m"] = target;
    EXPECT_EQ(profile_violations_of(spec_of_one(look)), count) << target.y << " " << target.z;
  }
}

TEST(ProfileViolations, ClipsAndTurnsAreHeldAgainstTheProfile) {
  Spec spec = spec_of_one(slow_walk());
  spec.sequences[0].clips[0].duration_frames = 40;
  EXPECT_EQ(profile_violations_of(spec), 1) << "it stretches nothing";
  spec.sequences[0].clips[0].duration_frames = 0;
  spec.sequences[0].clips[0].actions.push_back(slow_walk());
  EXPECT_EQ(profile_violations_of(spec), 1) << "one takes over from the other";
  spec.sequences[0].clips[0].actions[1].start_frame = 30;
  EXPECT_EQ(profile_violations_of(spec), 0);
  EXPECT_EQ(profile_violations(spec_of_one(use_of("walk", "waist")), Profile{}, stock_generator()), 0);
  Spec stretched = spec_of_one(use_of("walk", "waist"));
  stretched.sequences[0].clips[0].duration_frames = 4;
  EXPECT_EQ(profile_violations(stretched, Profile{}, stock_generator()), 1) << "20 frames is the least";
}

TEST(ProfileViolations, WhatALibraryDoesNotKnowIsSomebodyElsesError) {
  EXPECT_EQ(profile_violations_of(spec_of_one(use_of("walk", "head"))), 0) << "heads do not walk";
  Spec nobody = spec_of_one(slow_walk());
  nobody.character.name = "nobody";
  EXPECT_EQ(profile_violations_of(nobody), 0);
}

// A head that bends too far within 41 frames. Without its profile shrinking leaves the usual 30.
TEST(ProfileViolations, AShrunkCaseHasNoMoreThanItsOriginal) {
  ActionUse bend = use_of("pose", "head");
  bend.params["neck_flex_deg"] = 90.0;
  bend.duration_frames = 41;
  const Spec spec = spec_of_one(bend);
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage.ok());
  StageEvaluator evaluator;
  const Evaluation evaluation = evaluator.run(*stage);
  ASSERT_FALSE(evaluation.findings.empty());
  const Case original{spec, expectation_of(evaluator.execution(), evaluation, evaluation.findings.front()), {}};
  const Profile quick = profile_of(R"({"format": "contort.profile/1", "name": "quick", "shortest_frames": 40,
    "wild_poses": true})");
  ShrinkConfig config;
  const Shrunk free = shrink(original, stock_generator(), config);
  EXPECT_GT(profile_violations(free.minimal.spec, quick, stock_generator()), 0);
  config.allowed = within(quick, spec, stock_generator());
  const Shrunk kept = shrink(original, stock_generator(), config);
  EXPECT_EQ(profile_violations(kept.minimal.spec, quick, stock_generator()), 0) << pretty_spec(kept.minimal.spec);
  EXPECT_EQ(profile_violations(kept.worst.spec, quick, stock_generator()), 0) << pretty_spec(kept.worst.spec);
  EXPECT_EQ(kept.stopped, "fixpoint");
  const Shrunk again = shrink(kept.minimal, stock_generator(), config);
  EXPECT_EQ(again.minimal.spec, kept.minimal.spec);
}

}  // namespace
}  // namespace contort
