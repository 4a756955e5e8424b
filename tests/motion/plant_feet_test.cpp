// Recordings as targets of figures with mass: feet get places to stand on.
#include "generator/motion/plant_feet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "generator/generate.h"
#include "generator/motion/foot_rests.h"
#include "model/core/index.h"
#include "tests/character/stock.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/scenes.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

// Speeds with the same Froude number, v^2 / (g l).
double speed_m_s(const std::string& character) { return character == "quadruped" ? 0.6 : 0.8; }

Spec walk(const std::string& character) {
  Spec spec;
  spec.character.name = character;
  const char* slot = character == "quadruped" ? "hips" : "waist";
  spec.sequences = {fixtures::sequence({fixtures::use("walk", slot, 0, 300, {{"speed_m_s", speed_m_s(character)}})})};
  spec.hold_frames = 30;
  return spec;
}

// Flaws that motions get when they are taken over from another figure.
struct Flaws {
  double float_m = 0.0;
  double way = 1.0;  // the root's way is this many times as long
  double tilt_rad = 0.0;
  double tremble_rad = 0.0;
};

void spoil(const Character& character, const std::vector<Leg>& legs, const Flaws& flaws, Motion& motion) {
  for (int f = 0; f < motion.frame_count; ++f) {
    Vec3& root_m = motion.root[at(f)].p_m;
    root_m = {root_m.x * flaws.way, root_m.y + flaws.float_m, root_m.z * flaws.way};
    for (const Leg& leg : legs) {
      const Joint& ankle = character.joint(leg.ankles[0]);
      if (leg.ankle_count > 0) motion.row(f)[at(ankle.coord)] += flaws.tilt_rad;
      const Joint& hip = character.joint(leg.joints.front());
      if (coord_size(hip.kind) == 1) motion.row(f)[at(hip.coord)] += (f % 2 == 0 ? 1.0 : -1.0) * flaws.tremble_rad;
    }
  }
}

const std::vector<Flaws> kFlaws = {{0.03, 1.0, 0.0, 0.0}, {0.0, 1.1, 0.0, 0.0},      {0.0, 0.92, 0.0, 0.0},
                                   {0.0, 1.0, 0.2, 0.0},  {0.0, 1.0, 0.0, 0.0005}, {-0.02, 1.05, -0.15, 0.0005}};

// The number of findings about feet in a motion, by the checks.
int findings_about_feet(const Stage& stage, const Motion& motion) {
  Stage playing = stage;
  playing.recorded = std::make_shared<const Motion>(motion);
  StageEvaluator evaluator;
  const Evaluation seen = evaluator.run(playing);
  return static_cast<int>(std::ranges::count_if(seen.findings, [](const Finding& finding) {
    return finding.check == "foot_slide" || finding.check == "ground_penetration";
  }));
}

TEST(PlantFeet, RestingFeetStandStillOnTheGround) {
  for (const char* name : {"human", "mech", "quadruped"})
    for (const Flaws& flaws : kFlaws) {
      const Stage stage = *build_stage(walk(name), stock_library());
      Motion motion = generate(stage);
      spoil(*stage.character, stage.legs, flaws, motion);
      plant_feet(*stage.character, stage.legs, stage.environment, motion);
      EXPECT_EQ(findings_about_feet(stage, motion), 0)
          << name << " " << flaws.float_m << " " << flaws.way << " " << flaws.tilt_rad;
    }
}

TEST(PlantFeet, AWalkWhoseFeetStandChangesLittle) {
  for (const char* name : {"human", "mech", "quadruped"}) {
    const Stage stage = *build_stage(walk(name), stock_library());
    const Motion given = generate(stage);
    Motion planted = given;
    plant_feet(*stage.character, stage.legs, stage.environment, planted);
    for (int f = 0; f < given.frame_count; ++f)
      EXPECT_LT(length(planted.root[at(f)].p_m - given.root[at(f)].p_m), 0.03) << name << " " << f;
  }
}

TEST(PlantFeet, AFigureWithMassFollowsARecordingWhoseFeetFloatTiltAndSlide) {
  for (const Flaws& flaws : kFlaws) {
    Spec spec = walk("human");
    spec.dynamics.mode = Mode::dynamic;
    Stage stage = *build_stage(spec, stock_library());
    Motion recorded = generate(*build_stage(walk("human"), stock_library()));
    spoil(*stage.character, stage.legs, flaws, recorded);
    plant_feet(*stage.character, stage.legs, stage.environment, recorded);
    stage.recorded = std::make_shared<const Motion>(recorded);
    const Motion motion = generate(stage);
    for (int f = 0; f < motion.frame_count; ++f)
      ASSERT_EQ(motion.response.stances[at(f)].footing, Footing::standing)
          << f << " " << flaws.float_m << " " << flaws.way << " " << flaws.tilt_rad;
  }
}

// The frames [60, 240) of a walk, without its way.
Motion on_the_spot(const Motion& walk) {
  Motion out = walk;
  out.frame_count = 180;
  const auto first = at(60 * walk.coord_count), end = at(240 * walk.coord_count);
  out.coords.assign(walk.coords.begin() + static_cast<std::ptrdiff_t>(first),
                    walk.coords.begin() + static_cast<std::ptrdiff_t>(end));
  out.root.assign(walk.root.begin() + 60, walk.root.begin() + 240);
  const Vec3 way = (out.root.back().p_m - out.root.front().p_m) / 179.0;
  for (int f = 0; f < 180; ++f) out.root[at(f)].p_m -= static_cast<double>(f) * Vec3(way.x, 0.0, way.z);
  out.spans.clear(), out.queue.clear();
  return out;
}

TEST(PlantFeet, AWalkOnTheSpotGoesOnAsFastAsItsFeetSlid) {
  for (const char* name : {"human", "mech", "quadruped"}) {
    Spec spec = walk(name);
    spec.dynamics.mode = Mode::dynamic;
    Stage stage = *build_stage(spec, stock_library());
    const Motion given = generate(*build_stage(walk(name), stock_library()));
    const double given_m = length(given.root[239].p_m - given.root[60].p_m);
    Motion recorded = on_the_spot(given);
    plant_feet(*stage.character, stage.legs, stage.environment, recorded);
    const double way_m = length(recorded.root.back().p_m - recorded.root.front().p_m);
    EXPECT_NEAR(way_m, given_m, 0.05 * given_m) << name;
    stage.recorded = std::make_shared<const Motion>(recorded);
    const Motion motion = generate(stage);
    for (int f = 0; f < motion.frame_count; ++f)
      ASSERT_EQ(motion.response.stances[at(f)].footing, Footing::standing) << name << " " << f;
  }
}

TEST(PlantFeet, AFigureThatNeverTouchesTheGroundStaysInTheAir) {
  const Stage stage = *build_stage(walk("human"), stock_library());
  Motion motion = generate(stage);
  for (std::size_t f = 0; f < motion.root.size(); ++f) motion.root[f].p_m = Vec3(0.0, 5.0, 0.1 * static_cast<double>(f));
  const Motion given = motion;
  plant_feet(*stage.character, stage.legs, stage.environment, motion);
  for (std::size_t f = 0; f < motion.root.size(); ++f)
    EXPECT_LT(length(motion.root[f].p_m - given.root[f].p_m), 1e-6) << f;
}

}  // namespace
}  // namespace contort
