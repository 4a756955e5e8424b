// Legs between courses and actions of their own: they change hands without breaking a limit, however short a blend is,
// and go back to the course when their own action is over.
#include <gtest/gtest.h>

#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::stage_of;
using fixtures::use;

struct Blends {
  int in_frames = -1, out_frames = 0;
};

ActionUse course(const char* name, int start_frame, int duration_frames, std::map<std::string, ParamValue> params, Blends blends) {
  ActionUse made = use(name, "waist", start_frame, duration_frames, std::move(params));
  made.blend_in_frames = blends.in_frames, made.blend_out_frames = blends.out_frames;
  return made;
}

ActionUse leg_reach(int start_frame, int duration_frames, Vec3 target_m) {
  ActionUse made = use("reach", "leg_right", start_frame, duration_frames, {{"target_m", target_m}});
  return made;
}

std::string broken_by(std::vector<ActionUse> actions) {
  StageEvaluator evaluator;
  std::string all;
  for (const Finding& finding : evaluator.run(stage_of({sequence(std::move(actions))}, 10)).findings)
    all += finding.check + " " + finding.subject + "\n";
  return all;
}

TEST(LegHandover, ACourseThatBlendsInTooFastTakesTheTimeThatLegsNeed) {
  for (const int in_frames : {1, 2, 4, 7})
    for (const int start_frame : {20, 33, 41}) {
      const ActionUse deep = course("crouch", 0, 50, {{"share", 0.35}}, {});
      const ActionUse walk = course("walk", start_frame, 90, {{"speed_m_s", 1.0}}, {in_frames});
      EXPECT_EQ(broken_by({deep, walk}), "") << in_frames << " frames, from frame " << start_frame;
    }
}

TEST(LegHandover, ABendThatFadesOutWhileItGoesDownBeginsInTime) {
  for (const int out_frames : {1, 3, 8, 20})
    EXPECT_EQ(broken_by({course("crouch", 0, 34, {{"share", 0.34}}, {-1, out_frames})}), "") << out_frames << " frames";
}

TEST(LegHandover, ALegGoesBackToTheCourseWhenItsOwnActionIsOver) {
  for (const int out_frames : {0, 12})
    for (const char* name : {"crouch", "walk", "turn"}) {
      ActionUse lifted = leg_reach(30, 40, Vec3(-0.2, 0.4, 0.2));
      lifted.blend_out_frames = out_frames;
      const ActionUse under = course(name, 0, 150, {}, {});
      EXPECT_EQ(broken_by({under, lifted}), "") << name << ", fading for " << out_frames << " frames";
      const Stage stage = stage_of({sequence({under, lifted})}, 10);
      const Motion motion = generate(stage), alone = generate(stage_of({sequence({under})}, 10));
      const double angle = fixtures::coord(motion, 140, *stage.character, "leg_right/knee");
      EXPECT_NEAR(angle, fixtures::coord(alone, 140, *stage.character, "leg_right/knee"), 0.005) << name;
    }
}

TEST(LegHandover, ACourseTakesALegThatIsInTheAir) {
  for (const int start_frame : {20, 35, 50})
    for (const char* name : {"crouch", "walk", "squat"}) {
      const ActionUse lifted = leg_reach(0, 60, Vec3(-0.25, 0.5, -0.2));
      EXPECT_EQ(broken_by({lifted, course(name, start_frame, 110, {}, {6})}), "") << name << " at " << start_frame;
    }
}

TEST(LegHandover, AnAnkleKeepsItsRangeWhileItsLegReaches) {
  for (const Vec3 target_m : {Vec3(-0.2, 0.8, -0.15), Vec3(-0.3, 0.7, 0.0), Vec3(-0.1, 0.3, 0.4)})
    EXPECT_EQ(broken_by({course("squat", 0, 110, {}, {}), leg_reach(20, 60, target_m)}).find("joint_range"),
              std::string::npos);
}

TEST(LegHandover, ABlowDoesNotDragAFootThatStandsOnItsToes) {
  for (const double azimuth_deg : {-120.0, 0.0, 90.0}) {
    const ActionUse blow = use("hit_reaction", "leg_left", 50, 50, {{"azimuth_deg", azimuth_deg}});
    EXPECT_EQ(broken_by({course("squat", 5, 110, {{"share", 0.39}}, {}), blow}), "") << azimuth_deg;
  }
}

// The leg stopped within a frame where the course had seen it.
TEST(LegHandover, ALegThatIsTakenInTheMiddleOfABlowLosesItsSpeedSmoothly) {
  const auto mech = std::make_shared<const Character>(fixtures::built({"mech", {}, {}}));
  for (const char* name : {"crouch", "squat", "walk"})
    for (const double azimuth_deg : {-117.0, 180.0})
      for (const int start_frame : {3, 4, 6, 15}) {
        ActionUse blow = use("hit_reaction", "leg_left", 0, 36, {{"azimuth_deg", azimuth_deg}});
        blow.blend_in_frames = ActionUse{}.blend_in_frames;
        StageEvaluator evaluator;
        const Stage stage = stage_of({sequence({blow, course(name, start_frame, 110, {}, {})})}, 10, mech);
        EXPECT_TRUE(evaluator.run(stage, "angular_acceleration").findings.empty())
            << name << " at " << start_frame << ", " << azimuth_deg << " degrees";
      }
}

// A trunk that is hit in the first frame after a course moves the legs that it carries, not their feet.
TEST(LegHandover, FeetStayWhereACourseHasPutThemWhileATrunkIsHit) {
  Spec spec;
  spec.character.name = "quadruped";
  spec.sequences = {sequence({use("run", "hips", 0, 30, {})}),
                    sequence({use("hit_reaction", "trunk", 0, 30, {{"azimuth_deg", 120.0}})})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage.ok());
  EXPECT_TRUE(StageEvaluator().run(*stage).findings.empty());
}

// A bend that comes in and fades while it bends makes these ways at once.
TEST(LegHandover, BendsAreOnlyAsDeepAsLegsCanFollowWhileTheyComeInAndFade) {
  Spec spec;
  spec.character.name = "mech";
  ActionUse squat = course("squat", 0, 9, {}, {10, 1});
  squat.speed = 0.7;
  spec.sequences = {sequence({squat})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  ASSERT_TRUE(stage.ok());
  EXPECT_TRUE(StageEvaluator().run(*stage).findings.empty());
}

// Near its straight end a knee is fast: the leg must not be carried into the ground by hips that go down and lean.
TEST(LegHandover, ALegThatIsLiftedWhileABendBeginsKeepsTheSpeedsOfItsJoints) {
  const auto mech = std::make_shared<const Character>(fixtures::built({"mech", {}, {}}));
  const auto broken = [&](const ActionUse& bend, int start_frame) {
    StageEvaluator evaluator;
    std::string all;
    const ActionUse reach = use("reach", "leg_left", start_frame, 30, {{"target_m", Vec3(0.0, 1.0, 0.5)}});
    for (const Finding& finding : evaluator.run(stage_of({sequence({reach, bend})}, 20, mech)).findings)
      all += finding.check + " " + finding.subject + "\n";
    return all;
  };
  for (const int start_frame : {3, 4, 5, 6, 8}) {
    EXPECT_EQ(broken(course("squat", 0, 30, {{"lean_deg", 18.0}}, {}), start_frame), "") << "at " << start_frame;
    EXPECT_EQ(broken(course("crouch", 0, 30, {{"lean_deg", 38.0}}, {}), start_frame), "") << "at " << start_frame;
  }
}

}  // namespace
}  // namespace contort
