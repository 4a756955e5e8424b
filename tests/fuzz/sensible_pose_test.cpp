// Poses that are drawn put no body into another one.
#include "fuzz/sensible_pose.h"

#include <gtest/gtest.h>

#include "fuzz/compose.h"
#include "fuzz/draw.h"
#include "tests/character/stock.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

const OfferedAction& pose_of(const Character& character, int part) {
  return *find_offer(stock_generator().offers(character), part, "pose");
}

ActionUse made_sensible(const Character& character, const std::string& slot, std::map<std::string, ParamValue> values,
                        const Environment& environment = {}) {
  const int part = character.find_part(slot);
  ActionUse use;
  use.action = "pose", use.slot = slot, use.params = std::move(values);
  PosedFigure(character, environment)
      .add_sensible(character.parts()[static_cast<std::size_t>(part)], pose_of(character, part).params, use);
  return use;
}

TEST(SensiblePoses, LeaveAPoseThatIsClearAsItIs) {
  const std::map<std::string, ParamValue> clear = {{"elbow_deg", 60.0}};
  EXPECT_EQ(made_sensible(fixtures::built({"human", {}, {}}), "arm_left", clear).params, clear);
}

TEST(SensiblePoses, BringBackAHandThatWouldBeInTheChest) {
  const Character human = fixtures::built({"human", {}, {}});
  const std::map<std::string, ParamValue> into_chest = {{"shoulder_deg", Vec3(-40.0, 0.0, -40.0)},
                                                        {"elbow_deg", 140.0}};
  const ActionUse use = made_sensible(human, "arm_left", into_chest);
  EXPECT_NE(use.params, into_chest);
  EXPECT_EQ(use.params.size(), 2U) << "no parameter is lost";
  const auto collisions = [](const ActionUse& pose) {
    Spec spec;
    spec.character.name = "human";
    spec.hold_frames = 20;
    spec.sequences = {fixtures::sequence({pose})};
    StageEvaluator evaluator;
    return evaluator.run(*build_stage(spec, stock_library()), "self_collision").findings.size();
  };
  ActionUse as_drawn = use;
  as_drawn.params = into_chest;
  EXPECT_GT(collisions(as_drawn), 0U);
  EXPECT_EQ(collisions(use), 0U);
}

TEST(SensiblePoses, BringBackAHeadThatWouldBeInAStep) {
  const Character dog = fixtures::built({"quadruped", {}, {}});
  using Values = std::map<std::string, ParamValue>;
  const auto before_steps = [&](double start_m, int count, const Values& values) {
    EnvironmentDesc ahead;
    StepsGround steps;
    steps.start_m = start_m, steps.height_m = 0.22, steps.count = count;
    ahead.ground = steps;
    return made_sensible(dog, "head", values, build_environment(ahead).value()).params;
  };
  const Values lowered = {{"neck_flex_deg", 46.0}}, raised = {{"neck_flex_deg", -10.0}};
  EXPECT_NE(before_steps(0.67, 5, lowered), lowered);
  EXPECT_EQ(before_steps(2.0, 5, lowered), lowered);
  EXPECT_EQ(before_steps(0.2, 1, raised), raised) << "paws inside a step do not count";
}

TEST(SensiblePoses, PartsThatCarryASole) {
  const Character human = fixtures::built({"human", {}, {}});
  EXPECT_TRUE(carries_sole(human, human.find_part("leg_left")));
  EXPECT_TRUE(carries_sole(human, human.find_part("foot_right")));
  EXPECT_FALSE(carries_sole(human, human.find_part("arm_left")));
  EXPECT_FALSE(carries_sole(human, human.find_part("waist")));
}

// Cases of the default profile with all of their poses and nothing else. Poses of two parts that move at once may still
// meet, in 2 of these cases. 10 cases had a collision when each pose was only tried by itself.
TEST(SensiblePoses, PosesThatAreDrawnForOneFigureSeldomCollide) {
  const DrawConfig config{{"human", "mech", "quadruped"}};
  StageEvaluator evaluator;
  int poses = 0, failing = 0;
  for (int index = 0; index < 2000; ++index) {
    Spec spec = draw_spec(config, stock_generator(), 12, index);
    for (SequenceDesc& sequence : spec.sequences)
      for (ClipDesc& clip : sequence.clips) {
        std::erase_if(clip.actions, [](const ActionUse& use) { return use.action != "pose"; });
        poses += static_cast<int>(clip.actions.size());
      }
    spec.interrupts.clear();
    spec.dynamics = {}, spec.environment = {};
    const Result<Stage> stage = build_stage(spec, stock_library());
    ASSERT_TRUE(stage) << to_line(stage.issue());
    for (const char* check : {"self_collision", "joint_range"})
      failing += evaluator.run(*stage, check).findings.empty() ? 0 : 1;
  }
  EXPECT_GT(poses, 1000);
  EXPECT_LE(failing, 4);
}

// The figure alone, before anything moves, is never in its wall; and no default draw poses a leg.
TEST(SensiblePoses, DefaultDrawsStandBesideTheirWallsAndPoseNoLegs) {
  const DrawConfig config{{"human", "mech", "quadruped"}};
  StageEvaluator evaluator;
  int walls = 0;
  for (int index = 0; index < 300; ++index) {
    Spec spec = draw_spec(config, stock_generator(), 11, index);
    const Character character = build_character(spec.character, stock_library()).value();
    for (const SequenceDesc& sequence : spec.sequences)
      for (const ClipDesc& clip : sequence.clips)
        for (const ActionUse& use : clip.actions)
          EXPECT_FALSE(use.action == "pose" && carries_sole(character, character.find_part(use.slot))) << use.slot;
    walls += static_cast<int>(spec.environment.obstacles.size());
    spec.sequences.clear(), spec.interrupts.clear();
    spec.dynamics = {};
    EXPECT_TRUE(evaluator.run(*build_stage(spec, stock_library()), "obstacle_penetration").findings.empty()) << index;
  }
  EXPECT_GT(walls, 50);
}

}  // namespace

}  // namespace contort
