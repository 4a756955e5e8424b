// Limbs keep clear of bodies: they stop in front of them, and give way to approaching ones.
#include <gtest/gtest.h>

#include "generator/execute.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

std::vector<Finding> collisions(const Stage& stage) {
  StageEvaluator evaluator;
  return evaluator.run(stage, "self_collision").findings;
}

ActionUse through_the_trunk() { return use("reach", "arm_left", 0, 60, {{"target_m", Vec3(-0.1, 1.1, 0.0)}}); }

TEST(Clearance, AnArmThatIsSentIntoTheTrunkStopsBeforeItAndSaysSo) {
  const Stage stage = fixtures::stage_of({sequence({through_the_trunk()})}, 20);
  EXPECT_TRUE(collisions(stage).empty());
  const Intent intent = intent_of(stage);
  ASSERT_EQ(intent.unmet.size(), 1U);
  EXPECT_EQ(intent.unmet[0].why, Shortfall::clearance);
}

// When the action is over, the arm stays where it stopped.
TEST(Clearance, AnArmThatStoppedStaysThere) {
  const Stage stage = fixtures::stage_of({sequence({through_the_trunk()})}, 40);
  const Motion motion = generate(stage);
  for (std::size_t c = 0; c < motion.row(70).size(); ++c) EXPECT_NEAR(motion.row(100)[c], motion.row(70)[c], 1e-3) << c;
}

TEST(Clearance, ATrunkThatBendsAsidePutsNoArmIntoALeg) {
  for (const double azimuth_deg : {-90.0, 90.0, 0.0}) {
    const Stage stage = fixtures::stage_of(
        {sequence({use("hit_reaction", "torso", 0, 40, {{"azimuth_deg", azimuth_deg}, {"strength_deg", 60.0}})})}, 20);
    EXPECT_TRUE(collisions(stage).empty()) << azimuth_deg;
  }
}

// An author's pose is not changed; an arm with an action of its own gives way.
TEST(Clearance, AnArmGetsOutOfTheWayOfAPose) {
  const ActionUse look = use("direction", "torso", 0, 1, {});
  const ActionUse hold = use("reach", "arm_left", 0, 90, {{"target_m", Vec3(0.25, 0.95, 0.2)}});
  const ActionUse lift = use("pose", "leg_left", 30, 60, {{"hip_flex_deg", 60.0}, {"knee_deg", 60.0}});
  const Stage stage = fixtures::stage_of({sequence({look, hold, lift})}, 10);
  for (const Finding& finding : collisions(stage))
    EXPECT_EQ(finding.subject.find("arm_left"), std::string::npos) << finding.subject;
}

// Joints that may go on while the limb stops must be able to stop, too, wherever they are wanted next.
TEST(Clearance, AFastLegLosesItsSpeedBeforeItsOwnBodySmoothly) {
  const auto mech = std::make_shared<const Character>(fixtures::built({"mech", {}, {}}));
  for (const auto& character : {fixtures::shared_human(), mech})
    for (const double forward_m : {0.04, 0.3, 0.5})
      for (const double speed : {1.0, 1.15, 1.4, 2.0}) {
        ActionUse kick = use("reach", "leg_right", 0, 30, {{"target_m", Vec3(0.0, 1.0, forward_m)}});
        kick.blend_in_frames = ActionUse{}.blend_in_frames, kick.speed = speed;
        StageEvaluator evaluator;
        const Stage stage = fixtures::stage_of({sequence({kick})}, 10, character);
        EXPECT_TRUE(evaluator.run(stage, "angular_acceleration").findings.empty()) << forward_m << " m, " << speed;
      }
}

// The trunk comes towards the leg that rises beside it.
TEST(Clearance, ALegToWhichABodyHasComeTooNearLosesItsSpeedSmoothly) {
  const auto dog = std::make_shared<const Character>(fixtures::built({"quadruped", {}, {}}));
  const ActionUse blow = use("hit_reaction", "trunk", 20, 30, {{"azimuth_deg", -120.0}, {"strength_deg", 39.0}});
  ActionUse rise = use("reach", "leg_fore_left", 0, 30, {{"target_m", Vec3(0.28, 0.64, 0.99)}});
  rise.blend_in_frames = ActionUse{}.blend_in_frames;
  StageEvaluator evaluator;
  for (const Finding& finding : evaluator.run(fixtures::stage_of({sequence({blow, rise})}, 0, dog)).findings)
    ADD_FAILURE() << finding.check << " " << finding.subject << " at " << finding.worst_frame;
}

TEST(Clearance, PosesAreTakenAsTheyAre) {
  const ActionUse pose = use("pose", "arm_left", 0, 30, {{"shoulder_deg", Vec3(0.0, 0.0, -40.0)}});
  EXPECT_FALSE(collisions(fixtures::stage_of({sequence({pose})}, 5)).empty());
}

}  // namespace
}  // namespace contort
