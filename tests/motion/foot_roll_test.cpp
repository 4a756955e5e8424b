// Soles that roll, and the walks that need it.
#include "generator/motion/foot_roll.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/stage_evaluator.h"
#include "generator/generate.h"
#include "generator/motion/gait.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

Leg foot_of_30_cm() {
  Leg leg;
  leg.low_m = Vec3(-0.05, 0.0, -0.07), leg.high_m = Vec3(0.05, 0.0, 0.23);
  leg.sole_from_ankle = Vec3(0.0, 0.08, 0.0);
  return leg;
}

double drawn(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0; }

RC_GTEST_PROP(FootRoll, LowersNoPointOfTheSole, ()) {
  const Leg leg = foot_of_30_cm();
  const Rigid rolled = rolled_sole(leg, drawn(0.0, 0.8), drawn(0.0, 0.5));
  const Vec3 point(drawn(leg.low_m.x, leg.high_m.x), 0.0, drawn(leg.low_m.z, leg.high_m.z));
  RC_ASSERT((rolled * point).y >= -1e-12);
}

TEST(FootRoll, TurnsAboutTheEndsOfTheFootprint) {
  const Leg leg = foot_of_30_cm();
  const Vec3 toes(0.0, 0.0, leg.high_m.z), heel(0.0, 0.0, leg.low_m.z);
  EXPECT_LT(glm::length(rolled_sole(leg, 0.6, 0.0) * toes - toes), 1e-12);
  EXPECT_LT(glm::length(rolled_sole(leg, 0.0, 0.3) * heel - heel), 1e-12);
  EXPECT_NEAR((rolled_sole(leg, 0.6, 0.0) * heel).y, 0.3 * std::sin(0.6), 1e-12);
  EXPECT_NEAR((rolled_sole(leg, 0.0, 0.3) * toes).y, 0.3 * std::sin(0.3), 1e-12);
}

TEST(FootRoll, KnowsWhatAFootStandsOn) {
  const Leg leg = foot_of_30_cm();
  EXPECT_EQ(lower_end_m(leg, rolled_sole(leg, 0.6, 0.0)), Vec3(0.0, 0.0, leg.high_m.z));
  EXPECT_EQ(lower_end_m(leg, rolled_sole(leg, 0.0, 0.3)), Vec3(0.0, 0.0, leg.low_m.z));
  EXPECT_EQ(lower_end_m(leg, Rigid{}), Vec3(0.0));
}

// In stance, in swing and between them, a thousandth of a phase changes the share by a hundredth at most.
TEST(FootRoll, NeverJumps) {
  constexpr int kSteps = 1000;
  constexpr double kDuty = 0.6;
  for (const double peaks : {0.0, 0.3}) {
    const RollTimes times{.heel_peaks = peaks};
    double heel = heel_rise(times, kDuty, 0.0, 0.0), toes = toe_rise(times, 0.0, 0.0);
    for (int n = 1; n < 2 * kSteps; ++n) {
      const double stance = std::min(1.0, double(n) / kSteps), swing = std::max(0.0, double(n - kSteps) / kSteps);
      EXPECT_NEAR(heel_rise(times, kDuty, stance, swing), heel, 0.01) << n;
      EXPECT_NEAR(toe_rise(times, stance, swing), toes, 0.01) << n;
      heel = heel_rise(times, kDuty, stance, swing), toes = toe_rise(times, stance, swing);
    }
    EXPECT_NEAR(heel_rise(times, kDuty, 0.0, 0.0), heel, 0.01);
    EXPECT_NEAR(toe_rise(times, 0.0, 0.0), toes, 0.01);
    EXPECT_EQ(toe_rise(times, 0.4, 0.0), 0.0) << "it lies flat then";
  }
}

TEST(FootRoll, TurnsOnInTheAir) {
  const RollTimes times{.heel_peaks = 0.3};
  EXPECT_EQ(heel_rise(RollTimes{}, 0.6, 1.0, 0.0), 1.0);
  EXPECT_LT(heel_rise(times, 0.6, 1.0, 0.0), 0.95);
  EXPECT_EQ(heel_rise(times, 0.6, 1.0, 0.3), 1.0);
  EXPECT_EQ(heel_rise(times, 0.6, 1.0, times.heel_level), 0.0);
}

// A sole that lies on a slope is tilted, and stands on its toes for all that no more than a level one.
TEST(Walk, BeginsWhereFeetStandOnASlope) {
  for (const double slope_deg : {0.0, 12.0, 24.0})
    for (const double heading_deg : {0.0, 90.0, 180.0}) {
      Spec spec;
      spec.environment.ground = SlopeGround{slope_deg, heading_deg};
      const Result<Stage> stage = build_stage(spec, stock_library());
      ASSERT_TRUE(stage);
      Gait gait;
      gait.begin(*stage->character, stage->legs, stage->environment, {}, {});
      const auto stood = gait.first_soles();
      gait.begin(*stage->character, stage->legs, stage->environment, {}, std::span(stood).first(stage->legs.size()));
      EXPECT_EQ(gait.first_soles(), stood) << slope_deg << " to " << heading_deg;
    }
}

// Hips go up and down with the steps, and not where there is none: from a quarter of a cycle after the way until they
// rise.
TEST(Walk, HoldsItsHipsStillWhereItStands) {
  const Result<Stage> stage = build_stage(Spec{}, stock_library());
  ASSERT_TRUE(stage);
  const GaitParams params = walk_params(stage->legs, 1.2, 0.0);
  ASSERT_LT(params.bounce_m, -0.01);
  constexpr double kDuration_s = 6.0;
  Gait gait;
  gait.begin(*stage->character, stage->legs, stage->environment, {}, {});
  const auto hips_m = [&](double cycles_left) {
    return gait.at(params, kDuration_s - cycles_left * params.cycle_s, kDuration_s).root.p_m.y;
  };
  for (double cycles = 0.74; cycles > 0.5; cycles -= 0.02) EXPECT_NEAR(hips_m(cycles), hips_m(0.75), 1e-9) << cycles;
  EXPECT_GT(std::abs(hips_m(2.25) - hips_m(2.0)), 0.01) << "while it walks";
}

std::vector<std::string> found_in_walk(const std::string& character, double speed_m_s, double heading_deg = 0.0) {
  ActionUse use;
  use.action = "walk", use.slot = character == "quadruped" ? "hips" : "waist";
  use.duration_frames = 360;
  use.params = {{"speed_m_s", speed_m_s}, {"heading_deg", heading_deg}};
  Spec spec;
  spec.character.name = character;
  if (character == "reverse")
    spec.character = {"mech", {{"leg_left", "mech_leg_reverse"}, {"leg_right", "mech_leg_reverse"}}, {}};
  spec.sequences.resize(1);
  spec.sequences[0].clips.resize(1);
  spec.sequences[0].clips[0].actions = {use};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  std::vector<std::string> found;
  for (const Finding& f : StageEvaluator().run(*stage).findings)
    found.push_back(f.check + " " + f.subject + " at " + std::to_string(f.worst_frame));
  return found;
}

TEST(Walk, BreaksNoLimitAtTheSpeedsItIsMadeFor) {
  const std::vector<std::pair<std::string, double>> fastest = {
      {"human", 1.4}, {"mech", 1.3}, {"reverse", 1.3}, {"quadruped", 0.9}};
  for (const auto& [character, most_m_s] : fastest)
    for (double speed_m_s = 0.1; speed_m_s < most_m_s + 0.01; speed_m_s += 0.1)
      EXPECT_EQ(found_in_walk(character, speed_m_s), std::vector<std::string>{}) << character << " at " << speed_m_s;
}

}  // namespace
}  // namespace contort
