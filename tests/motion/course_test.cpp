// Courses of legs in specs: their direction and speed, and notes about speeds that legs cannot reach.
#include <gtest/gtest.h>

#include <cmath>

#include "generator/execute.h"
#include "model/core/index.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

struct Went {
  Motion motion;
  Intent intent;
  std::vector<Finding> findings;
  std::shared_ptr<const Character> character;

  double facing_deg() const {
    const Vec3 ahead = motion.root.back().q * Vec3(0, 0, 1);
    return std::atan2(ahead.x, ahead.z) * kDegPerRad;
  }
  Vec3 way_m() const { return motion.root.back().p_m - motion.root.front().p_m; }
};

Went went(const std::string& action, double speed_m_s, double heading_deg, int frames = 420) {
  ActionUse course = use(action, "waist", 0, frames, {{"speed_m_s", speed_m_s}, {"heading_deg", heading_deg}});
  course.blend_in_frames = -1;
  Spec spec;
  spec.character.name = "human";
  spec.hold_frames = 10;
  spec.sequences = {sequence({course})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  StageEvaluator evaluator;
  std::vector<Finding> findings = evaluator.run(*stage).findings;
  return {generate(*stage), intent_of(*stage), std::move(findings), stage->character};
}

void expect_clean(const Went& course, const std::string& what) {
  for (const Finding& finding : course.findings) ADD_FAILURE() << what << ": " << finding.check << " " << finding.subject;
  EXPECT_TRUE(course.intent.unmet.empty()) << what;
}

TEST(Course, AWalkTurnsToItsHeadingAndGoesThere) {
  for (const double heading_deg : {-150.0, -90.0, 30.0, 120.0}) {
    const Went walk = went("walk", 1.2, heading_deg);
    expect_clean(walk, std::to_string(heading_deg));
    EXPECT_NEAR(walk.facing_deg(), heading_deg, 0.1);
    EXPECT_GT(std::sqrt(glm::dot(walk.way_m(), walk.way_m())), 3.0) << heading_deg;
  }
}

TEST(Course, ASlowWalkGoesSidewaysAndFacesTheSameWay) {
  const Went walk = went("walk", 0.3, 90.0);
  expect_clean(walk, "sideways");
  EXPECT_NEAR(walk.facing_deg(), 0.0, 1e-6);
  EXPECT_GT(walk.way_m().x, 1.0);
  EXPECT_NEAR(walk.way_m().z, 0.0, 1e-6);
}

TEST(Course, AWalkBackwardKeepsFacingForward) {
  const Went walk = went("walk", 0.8, 180.0);
  expect_clean(walk, "backward");
  EXPECT_NEAR(walk.facing_deg(), 0.0, 1e-6);
  EXPECT_LT(walk.way_m().z, -3.0);
}

TEST(Course, PeopleWalkUpToTwoMetresASecondAndRunAtThree) {
  for (const double speed_m_s : {0.3, 0.8, 1.4, 2.0}) expect_clean(went("walk", speed_m_s, 0.0), "walk");
  for (const double speed_m_s : {2.0, 3.0}) expect_clean(went("run", speed_m_s, 0.0), "run");
}

TEST(Course, ARunThatLegsCannotMakeIsSlowerAndSaysSo) {
  const Went run = went("run", 8.0, 0.0);
  EXPECT_TRUE(run.findings.empty());
  ASSERT_EQ(run.intent.unmet.size(), 1U);
  EXPECT_EQ(run.intent.unmet[0].why, Shortfall::joint_speed);
  EXPECT_GT(run.way_m().z, 8.0) << "it does run";
}

TEST(Course, ATurnThatIsTooShortOfTimeSaysSo) {
  const Went walk = went("walk", 1.2, 150.0, 70);
  EXPECT_TRUE(walk.findings.empty());
  ASSERT_EQ(walk.intent.unmet.size(), 1U);
  EXPECT_EQ(walk.intent.unmet[0].why, Shortfall::joint_speed);
}

TEST(Course, IdleArmsSwingAgainstTheLegs) {
  const Went walk = went("walk", 1.2, 0.0);
  double against = 0.0;
  for (int f = 120; f < 300; ++f) {
    const double left = fixtures::coord(walk.motion, f, *walk.character, "leg_left/hip_flex");
    const double right = fixtures::coord(walk.motion, f, *walk.character, "leg_right/hip_flex");
    const Joint& shoulder = fixtures::joint(*walk.character, "arm_left/shoulder");
    const double* q = walk.motion.row(f).data() + shoulder.coord;
    against += (left - right) * std::atan2(q[1], q[0]);  // about +X: positive is backward
  }
  EXPECT_GT(against, 2.0) << "the left arm is behind while the left leg is in front";
}

// The findings of one run, by check and subject, one a line.
std::string findings_of_run(const std::string& character, const ActionUse& run, const Ground& ground = {}) {
  Spec spec;
  spec.character.name = character;
  spec.environment.ground = ground;
  spec.hold_frames = 10;
  spec.sequences = {sequence({run})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) return to_line(stage.issue());
  StageEvaluator evaluator;
  std::string lines;
  for (const Finding& finding : evaluator.run(*stage).findings) lines += finding.check + " " + finding.subject + "\n";
  return lines;
}

// Hips of a runner are not held by a foot that swings, but at the end both stand, however short the run was.
TEST(Course, AShortRunOnASlopeEndsWithHipsWhereLegsReach) {
  for (const char* name : {"mech", "human"})
    for (const int frames : {17, 24, 40}) {
      ActionUse run = use("run", "waist", 0, frames, {});
      run.blend_in_frames = -1;
      EXPECT_EQ(findings_of_run(name, run, SlopeGround{.slope_deg = 22.0, .heading_deg = -104.0}), "")
          << name << ", " << frames << " frames";
    }
}

// The start of a run consists of the run and its blend; together they must be slow enough for knees.
TEST(Course, ARunThatIsPlayedFastComesInAsFastAsKneesBend) {
  for (const double speed : {1.25, 2.0})
    for (const int blend : {-1, 3, 10}) {
      ActionUse run = use("run", "waist", 1, 32, {{"speed_m_s", 7.5}});
      run.speed = speed, run.blend_in_frames = blend;
      EXPECT_EQ(findings_of_run("mech", run), "") << "speed " << speed << ", blend " << blend;
    }
}

}  // namespace
}  // namespace contort
