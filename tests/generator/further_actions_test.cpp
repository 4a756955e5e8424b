// An aim at a target behind the figure turns the torso, and then the figure (docs/internals/aim.md). Also tests turns
// on the spot alone.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "generator/execute.h"
#include "model/core/detmath.h"
#include "model/motion/kinematics.h"
#include "model/motion/legs.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;

constexpr int kFrames_s = 60;

ActionUse lasting(const std::string& action, const std::string& slot, int start, int frames,
                  std::map<std::string, ParamValue> params) {
  ActionUse use = fixtures::use(action, slot, start, frames, std::move(params));
  use.blend_in_frames = -1;
  return use;
}

Vec3 point_at(double azimuth_deg, double away_m = 6.0, double up_m = 1.2) {
  const det::SinCos azimuth = det::sincos(azimuth_deg * kRadPerDeg);
  return {away_m * azimuth.sin, up_m, away_m * azimuth.cos};
}

// A character that plays some actions, and the result.
class Aimed {
 public:
  Aimed(const CharacterChoice& choice, std::vector<ActionUse> actions) {
    Spec spec;
    spec.character = choice;
    spec.sequences = {sequence(std::move(actions))};
    spec.rate_hz = kFrames_s;
    Result<Stage> built = build_stage(spec, stock_library());
    if (!built) throw std::logic_error(to_line(built.issue()));
    stage = std::move(built).value();
    StageEvaluator evaluator;
    findings = evaluator.run(stage).findings;
    execution = evaluator.execution();
  }

  // The slots that an action moved.
  std::set<std::string> moved() const {
    std::set<std::string> slots;
    for (const ActionSpan& span : execution.motion.spans)
      slots.insert(stage.character->parts()[static_cast<std::size_t>(span.part)].slot);
    return slots;
  }
  // Returns the angle between a socket's +Z and the direction to a point in the last frame.
  double off_rad(const std::string& socket, const Vec3& target_m) const {
    const Motion& motion = execution.motion;
    std::vector<Rigid> world(stage.character->joints().size());
    const int last = motion.frame_count - 1;
    forward_kinematics(*stage.character, motion.root[static_cast<std::size_t>(last)], motion.row(last), world);
    const Rigid at = world_from_socket(*stage.character, world, stage.character->find_socket(socket));
    return det::acos(std::min(1.0, dot(at.q * Vec3(0, 0, 1), glm::normalize(target_m - at.p_m))));
  }
  double faces_deg() const {
    const Vec3 forward = execution.motion.root.back().q * Vec3(0, 0, 1);
    return det::atan2(forward.x, forward.z) / kRadPerDeg;
  }

  Stage stage;
  Execution execution;
  std::vector<Finding> findings;
};

const CharacterChoice kWithRifle{"human", {}, {{"rifle", "hand_right", "grip"}}};

Aimed aims(const CharacterChoice& choice, const std::string& slot, const Vec3& target_m) {
  return {choice, {lasting("aim", slot, 0, 8 * kFrames_s, {{"target_m", target_m}})}};
}

struct Chain {
  CharacterChoice choice;
  std::string slot, socket;
};

class FurtherActions : public testing::TestWithParam<Chain> {};

TEST_P(FurtherActions, MeetAnAimInAnyDirectionWithoutFault) {
  const Chain& chain = GetParam();
  for (int azimuth_deg = -180; azimuth_deg < 180; azimuth_deg += 40) {
    const Vec3 target_m = point_at(azimuth_deg);
    const Aimed aimed = aims(chain.choice, chain.slot, target_m);
    EXPECT_LT(aimed.off_rad(chain.socket, target_m), 1e-3) << azimuth_deg;
    EXPECT_TRUE(aimed.findings.empty()) << azimuth_deg << ": " << aimed.findings.front().check << " "
                                        << aimed.findings.front().subject;
    const bool is_behind = std::abs(azimuth_deg) >= 100;
    EXPECT_EQ(std::fabs(aimed.faces_deg()) > 61.0, is_behind) << azimuth_deg;
  }
}

INSTANTIATE_TEST_SUITE_P(Chains, FurtherActions,
                         testing::Values(Chain{{"human", {}, {}}, "head", "head/face"},
                                         Chain{{"human", {}, {}}, "torso", "torso/chest"},
                                         Chain{kWithRifle, "arm_right", "object:rifle/muzzle"},
                                         Chain{{"mech", {}, {}}, "arm_left", "arm_left/grip"},
                                         Chain{{"quadruped", {}, {}}, "head", "head/face"}),
                         [](const auto& one) { return one.param.choice.name + "_" + one.param.slot; });

TEST(FurtherAction, ATargetInFrontMovesTheArmAlone) {
  EXPECT_EQ(aims(kWithRifle, "arm_right", point_at(-10)).moved(), (std::set<std::string>{"arm_right", "hand_right"}));
}

TEST(FurtherAction, ATargetAtTheSideHasTheTorsoTurnAndTheFeetStand) {
  const Aimed aimed = aims(kWithRifle, "arm_right", point_at(80));
  EXPECT_EQ(aimed.moved(), (std::set<std::string>{"arm_right", "hand_right", "torso"}));
  EXPECT_EQ(aimed.faces_deg(), 0.0);
}

TEST(FurtherAction, WhatTheSpecGivesATorsoIsNotTakenFromIt) {
  const Aimed aimed(kWithRifle, {lasting("look_at", "torso", 0, 300, {{"target_m", point_at(0)}}),
                                lasting("aim", "arm_right", 0, 300, {{"target_m", point_at(80)}})});
  for (const ActionSpan& span : aimed.execution.motion.spans) {
    const bool is_torso = span.part == aimed.stage.character->find_part("torso");
    EXPECT_TRUE(!is_torso || span.action == 0);
  }
}

TEST(FurtherAction, AWalkGoesOn) {
  const Aimed aimed(kWithRifle, {lasting("walk", "waist", 0, 300, {{"speed_m_s", 0.8}}),
                                lasting("aim", "arm_right", 0, 300, {{"target_m", point_at(170)}})});
  EXPECT_GT(aimed.execution.motion.root.back().p_m.z, 2.0);
  EXPECT_LT(std::fabs(aimed.faces_deg()), 1.0);
}

// A figure that stepped round for its head would take its torso from its own target.
TEST(FurtherAction, AnotherAimKeepsTheFigureWhereItFaces) {
  const Aimed aimed({"human", {}, {}}, {lasting("aim", "torso", 0, 300, {{"target_m", point_at(20)}}),
                                        lasting("aim", "head", 0, 300, {{"target_m", point_at(-150)}})});
  EXPECT_LT(std::fabs(aimed.faces_deg()), 1.0);
  EXPECT_LT(aimed.off_rad("torso/chest", point_at(20)), 1e-3);
}

TEST(FurtherAction, ATailDoesNotTurnTheAnimal) {
  const Aimed aimed = aims({"quadruped", {}, {}}, "tail", point_at(0));
  EXPECT_EQ(aimed.moved(), std::set<std::string>{"tail"});
}

// A target that is not reached on the way is no unmet request; one that is not reached at the end is.
TEST(FurtherAction, IsAnUnmetRequestOnlyWhereItDoesNotGetThere) {
  EXPECT_TRUE(aims({"quadruped", {}, {}}, "head", point_at(150)).execution.intent->unmet.empty());
  const Aimed hurried({"human", {}, {}}, {lasting("aim", "head", 0, 80, {{"target_m", point_at(170)}})});
  ASSERT_EQ(hurried.execution.intent->unmet.size(), 1U);
  EXPECT_EQ(hurried.execution.intent->unmet.front().last_frame, 80);
}

TEST(FurtherAction, AnAimThatWasCutIsHelpedAgain) {
  Spec spec;
  spec.character = kWithRifle;
  spec.rate_hz = kFrames_s;
  spec.sequences = {sequence({lasting("aim", "arm_right", 0, 480, {{"target_m", point_at(150)}})})};
  InterruptDesc cut;
  cut.when.event = Event::frame, cut.when.frame = 60;
  cut.enter = Enter::front, cut.resume = true;
  cut.sequence = sequence({lasting("pose", "arm_right", 0, 30, {})});
  spec.interrupts = {cut};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage) << to_line(stage.issue());
  const Motion motion = generate(*stage);
  ASSERT_FALSE(motion.aims.empty());
  EXPECT_GT(motion.aims.back().last_frame, 500);
}

const CharacterChoice kReverse{"mech", {{"leg_left", "mech_leg_reverse"}, {"leg_right", "mech_leg_reverse"}}, {}};

// The line of aim passes near the shoulder, not half a metre below it, as with an arm that hangs.
TEST(FurtherAction, AnAimedRifleIsHeldUp) {
  const Aimed aimed = aims(kWithRifle, "arm_right", point_at(-10));
  const Motion& motion = aimed.execution.motion;
  std::vector<Rigid> world(aimed.stage.character->joints().size());
  forward_kinematics(*aimed.stage.character, motion.root.back(), motion.row(motion.frame_count - 1), world);
  const Rigid muzzle =
      world_from_socket(*aimed.stage.character, world, aimed.stage.character->find_socket("object:rifle/muzzle"));
  const Rigid shoulder =
      world_from_socket(*aimed.stage.character, world, aimed.stage.character->find_socket("torso/shoulder_right"));
  const Vec3 along = muzzle.q * Vec3(0, 0, 1), apart_m = muzzle.p_m - shoulder.p_m;
  EXPECT_LT(length(apart_m - dot(apart_m, along) * along), 0.3);
}

class TurnOnTheSpot : public testing::TestWithParam<CharacterChoice> {};

TEST_P(TurnOnTheSpot, FacesThePointWithItsFeetAtHome) {
  const std::string slot = GetParam().name == "quadruped" ? "hips" : "waist";
  for (const int azimuth_deg : {-170, -90, -30, 15, 100, 180}) {
    const Aimed turned(GetParam(), {lasting("turn", slot, 0, 7 * kFrames_s, {{"target_m", point_at(azimuth_deg)}})});
    EXPECT_TRUE(turned.findings.empty()) << azimuth_deg << ": " << turned.findings.front().check;
    EXPECT_TRUE(turned.execution.intent->unmet.empty()) << azimuth_deg;
    const double off_deg = turned.faces_deg() - azimuth_deg;
    EXPECT_LT(std::fabs(off_deg - 360.0 * std::round(off_deg / 360.0)), 0.1) << azimuth_deg;
    const Motion& motion = turned.execution.motion;
    std::vector<Rigid> world(turned.stage.character->joints().size());
    forward_kinematics(*turned.stage.character, motion.root.back(), motion.row(motion.frame_count - 1), world);
    const Rigid& root = motion.root.back();
    for (const Leg& leg : turned.stage.legs) {
      const Vec3 sole_m = inverse(root) * world_from_socket(*turned.stage.character, world, leg.sole).p_m;
      EXPECT_LT(std::fabs(sole_m.x - leg.home_m.x), 0.005) << azimuth_deg;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Stock, TurnOnTheSpot,
                         testing::Values(CharacterChoice{"human", {}, {}}, CharacterChoice{"mech", {}, {}}, kReverse,
                                         CharacterChoice{"quadruped", {}, {}}),
                         [](const auto& one) { return one.param.name + (one.param.parts.empty() ? "" : "_reverse"); });

}  // namespace
}  // namespace contort
