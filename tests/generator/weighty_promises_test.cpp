// Motions that the ground can hold: figures with mass shift their weight before they lift a foot, bend over their feet,
// and aim exactly.
#include <gtest/gtest.h>

#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

// The findings of actions on a standing figure with mass, one a line; of one check, if it is named.
std::string found(const std::string& character, std::vector<ActionUse> actions, std::string_view check = {}) {
  Spec spec;
  spec.character.name = character;
  spec.dynamics.mode = Mode::tracking;
  spec.hold_frames = 30;
  for (ActionUse& action : actions) action.blend_in_frames = -1;
  spec.sequences = {sequence(std::move(actions))};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) return to_line(stage.issue());
  StageEvaluator evaluator;
  std::string lines;
  for (const Finding& finding : evaluator.run(*stage).findings)
    if (check.empty() || finding.check == check) lines += finding.check + " " + finding.subject + "\n";
  return lines;
}

std::string found(const std::string& character, const ActionUse& action, std::string_view check = {}) {
  return found(character, std::vector{action}, check);
}

TEST(WeightyPromises, ALegIsLiftedWithTheWeightOverTheOther) {
  for (const char* leg : {"leg_left", "leg_right"}) {
    for (const double azimuth_deg : {-120.0, 0.0, 60.0})
      EXPECT_EQ(found("human", use("hit_reaction", leg, 0, 50, {{"azimuth_deg", azimuth_deg}, {"strength_deg", 25.0}})),
                "")
          << leg << azimuth_deg;
  }
  EXPECT_EQ(found("human", use("hit_reaction", "foot_left", 0, 50, {{"azimuth_deg", 30.0}, {"strength_deg", 20.0}})),
            "");
  EXPECT_EQ(
      found("quadruped", use("hit_reaction", "leg_fore_left", 0, 34, {{"azimuth_deg", 2.0}, {"strength_deg", 49.0}})),
      "");
}

TEST(WeightyPromises, SquatsAndCrouchesStayOverTheFeet) {
  for (const char* bend : {"squat", "crouch"})
    for (const double lean_deg : {0.0, 20.0, 45.0}) {
      EXPECT_EQ(found("human", use(bend, "waist", 0, 60, {{"share", 0.15}, {"lean_deg", lean_deg}})), "")
          << bend << lean_deg;
      EXPECT_EQ(found("mech", use(bend, "waist", 0, 60, {{"share", 0.15}, {"lean_deg", lean_deg}})), "")
          << bend << lean_deg;
    }
}

TEST(WeightyPromises, ALegIsHeldOutOnlyAsFarAsTheOtherOneBears) {
  for (const Vec3& target_m : {Vec3(-0.86, 0.97, 0.11), Vec3(0.86, 0.97, 0.11), Vec3(-0.6, 1.3, 0.4)})
    EXPECT_EQ(found("human", use("reach", "leg_right", 0, 57, {{"target_m", target_m}})), "") << target_m.x;
  for (const Vec3& target_m : {Vec3(0.94, 1.76, 0.08), Vec3(0.78, 1.59, 0.05)})
    EXPECT_EQ(found("mech", use("reach", "leg_left", 0, 67, {{"target_m", target_m}})), "") << target_m.x;
}

TEST(WeightyPromises, ACrouchThatLeansBackStaysInTheRangesOfItsAnkles) {
  const std::map<std::string, ParamValue> back = {{"share", 0.6}, {"lean_deg", -30.0}, {"back_m", -0.07}};
  for (const char* name : {"human", "mech"}) EXPECT_EQ(found(name, use("crouch", "waist", 0, 60, back)), "") << name;
}

// A blow on the leg that bears, and blows on both feet at the same time.
TEST(WeightyPromises, AFootStaysWhereTheOtherOneIsLifted) {
  const std::map<std::string, ParamValue> aside = {{"azimuth_deg", 30.0}, {"strength_deg", 25.0}};
  const ActionUse left = use("hit_reaction", "foot_left", 0, 50, {{"azimuth_deg", 30.0}, {"strength_deg", 20.0}});
  ActionUse right = left;
  right.slot = "foot_right";
  EXPECT_EQ(found("human", {left, right}), "");
  const ActionUse reach = use("reach", "leg_left", 0, 90, {{"target_m", Vec3(0.2, 0.4, 0.4)}});
  EXPECT_EQ(found("human", {reach, use("hit_reaction", "leg_right", 20, 50, aside)}), "");
}

TEST(WeightyPromises, WalksAndTurnsKeepTheBalanceWhereFeetComeAndGo) {
  for (const double heading_deg : {0.0, 90.0, 180.0}) {
    const std::map<std::string, ParamValue> slow = {{"speed_m_s", 0.5}, {"heading_deg", heading_deg}};
    EXPECT_EQ(found("human", use("walk", "waist", 0, 180, slow), "balance"), "") << heading_deg;
    EXPECT_EQ(found("quadruped", use("walk", "hips", 0, 180, slow), "balance"), "") << heading_deg;
  }
  EXPECT_EQ(found("human", use("walk", "waist", 0, 180, {{"speed_m_s", 0.5}})), "");
  const std::map<std::string, ParamValue> behind = {{"target_m", Vec3(2.0, 1.0, -1.0)}};
  for (const char* name : {"human", "mech"})
    EXPECT_EQ(found(name, use("turn", "waist", 0, 180, behind), "balance"), "") << name;
}

TEST(WeightyPromises, HeadsAndTrunksArriveWhereTheyLook) {
  for (const Vec3& target_m : {Vec3(0.42, 1.53, 0.94), Vec3(-0.66, 1.9, 1.76), Vec3(0.08, 1.39, 0.83)})
    EXPECT_EQ(found("human", use("aim", "torso", 0, 60, {{"point", std::string("chest")}, {"target_m", target_m}}),
                    "aim_error"),
              "")
        << target_m.x << ": hips have swayed aside";
  EXPECT_EQ(
      found("quadruped", use("aim", "head", 0, 60, {{"point", std::string("face")}, {"target_m", Vec3(1, 1.2, 1.5)}})),
      "");
  EXPECT_EQ(found("quadruped", use("look_at", "trunk", 0, 60, {{"target_m", Vec3(1, 3, 2)}})), "");
}

}  // namespace
}  // namespace contort
