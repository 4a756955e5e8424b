// Targets that physics allows, and figures that follow them.
#include "generator/dynamics/possible.h"

#include <gtest/gtest.h>

#include <cmath>

#include "generator/motion/soft_height.h"
#include "generator/dynamics/support_hull.h"
#include "generator/execute.h"
#include "generator/generate.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

Spec going(const std::string& name, const std::string& action, double speed_m_s, double heading_deg, Mode mode) {
  Spec spec;
  spec.character.name = name;
  spec.sequences = {sequence({use(action, name == "quadruped" ? "hips" : "waist", 0, 360,
                                  {{"speed_m_s", speed_m_s}, {"heading_deg", heading_deg}})})};
  spec.hold_frames = 60;
  spec.dynamics.mode = mode;
  return spec;
}

Stage built_stage(const Spec& spec) {
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return *stage;
}

Spec walking(const std::string& name, double speed_m_s, Mode mode) { return going(name, "walk", speed_m_s, 0.0, mode); }

// The target of a stage as actions made it, and as it was made possible.
struct Made {
  explicit Made(const Spec& spec) : stage(built_stage(spec)) {
    Stage kinematic = stage;
    kinematic.dynamics = nullptr;
    original = generate(kinematic);
    motion = original;
    plan = ContactPlan(*stage.character, stage.dynamics->figure, stage.environment, motion);
    balance = make_possible(*stage.character, stage.dynamics->figure, stage.dynamics->easy, plan,
                            stage.dynamics->ticks_per_frame, motion);
  }

  // The error of soles that carry weight, or of soles in the air.
  double greatest_sole_error_m(bool bears) const {
    std::vector<Rigid> world(stage.character->joints().size());
    double most = 0.0;
    for (int f = 0; f < motion.frame_count; ++f) {
      forward_kinematics(*stage.character, motion.root[static_cast<std::size_t>(f)], motion.row(f), world);
      for (std::size_t i = 0; i < stage.dynamics->figure.soles.size(); ++i) {
        const Sole& sole = stage.dynamics->figure.soles[i];
        const Rigid now = world[static_cast<std::size_t>(sole.link)] * sole.link_from_sole;
        if ((plan.bearing(f, static_cast<int>(i)).corners != 0) == bears)
          most = std::max(most, length(now.p_m - plan.sole(f, static_cast<int>(i)).p_m));
      }
    }
    return most;
  }

  Stage stage;
  Motion original, motion;
  ContactPlan plan;
  BalancePlan balance;
};

TEST(Possible, AFigureThatStandsStaysAsItIsBitByBit) {
  Spec spec;
  spec.character.name = "human";
  spec.hold_frames = 20;
  spec.dynamics.mode = Mode::dynamic;
  const Made made(spec);
  EXPECT_EQ(motion_hash(made.motion), motion_hash(made.original));
}

// A linear inverted pendulum over feet at a distance W sways by W (1 - 1 / cosh(w T / 2)), and people by 1.2 to 1.9
// times that (shared study of locomotion); here feet are used from their inner edges on.
TEST(Possible, AWalkSwaysOverTheStandingFootAndSolesStayWhereTheyAre) {
  const Made made(walking("human", 0.9, Mode::dynamic));
  EXPECT_LT(made.greatest_sole_error_m(true), 1e-6);
  EXPECT_LT(made.greatest_sole_error_m(false), 0.01);
  double left_m = 0.0, right_m = 0.0;
  for (int f = 150; f < 250; ++f) {
    left_m = std::max(left_m, made.motion.root[static_cast<std::size_t>(f)].p_m.x);
    right_m = std::min(right_m, made.motion.root[static_cast<std::size_t>(f)].p_m.x);
  }
  EXPECT_GT(left_m - right_m, 0.015);
  EXPECT_LT(left_m - right_m, 0.06);
  EXPECT_NEAR(left_m, -right_m, 0.005);
}

TEST(Possible, TheZeroMomentPointOfAWalkStaysUnderTheFeet) {
  const Made made(walking("quadruped", 0.6, Mode::dynamic));
  Motion again = made.motion;
  make_possible(*made.stage.character, made.stage.dynamics->figure, made.stage.dynamics->easy, made.plan,
                made.stage.dynamics->ticks_per_frame, again);
  for (std::size_t f = 0; f < again.root.size(); ++f)
    EXPECT_LT(length(again.root[f].p_m - made.motion.root[f].p_m), 2e-3) << f;
}

struct Followed {
  double farthest_m = 0.0;
  double farthest_deg = 0.0;
  bool stood = true;
};

Followed followed(const Spec& spec) {
  const Motion motion = generate(built_stage(spec));
  Followed out;
  for (std::size_t f = 0; f < motion.root.size(); ++f) {
    const Rigid& target = motion.response.target_root[f];
    out.farthest_m = std::max(out.farthest_m, length(motion.root[f].p_m - target.p_m));
    out.farthest_deg =
        std::max(out.farthest_deg, kDegPerRad * rotation_angle(glm::conjugate(target.q) * motion.root[f].q));
    out.stood = out.stood && motion.response.stances[f].footing == Footing::standing;
  }
  return out;
}

TEST(Possible, DynamicWalksWithAPackStayUp) {
  for (const char* name : {"human", "mech"})
    for (const double mass_kg : {5.0, 8.0})
      for (const double speed_m_s : {0.5, 0.9, 1.2}) {
        Spec spec = walking(name, speed_m_s, Mode::dynamic);
        spec.dynamics.loads = {{"torso", "back", {}, {0.3, 0.4, 0.15}, mass_kg}};
        EXPECT_TRUE(followed(spec).stood) << name << " " << speed_m_s << " " << mass_kg;
      }
}

void expect_to_stay_up(const std::string& name, const std::string& action, double speed_m_s, double heading_deg) {
  const Followed way = followed(going(name, action, speed_m_s, heading_deg, Mode::dynamic));
  const std::string what = name + " " + action + " " + std::to_string(speed_m_s) + " " + std::to_string(heading_deg);
  EXPECT_TRUE(way.stood) << what;
  EXPECT_LT(way.farthest_m, 0.05) << what;
  EXPECT_LT(way.farthest_deg, 5.0) << what;
}

TEST(Possible, DynamicWalksStayUpAndNearTheirTargets) {
  for (const char* name : {"human", "mech", "quadruped"})
    for (const double speed_m_s : {0.4, 0.6, 0.8, 1.0, 1.2, 1.4}) expect_to_stay_up(name, "walk", speed_m_s, 0.0);
}

TEST(Possible, DynamicWalksInAllDirectionsStayUpAndNearTheirTargets) {
  for (const char* name : {"human", "quadruped"})
    for (const double heading_deg : {-135.0, -90.0, 45.0, 180.0}) expect_to_stay_up(name, "walk", 0.9, heading_deg);
}

// On flat feet, legs that swung as quickly as in a walk forward needed a fifth more than the strength of the hips.
TEST(Possible, WalksBackwardStayWithinTheStrengthOfTheHips) {
  for (const double speed_m_s : {0.5, 0.8})
    for (const double heading_deg : {-150.0, 180.0}) {
      const Spec spec = going("human", "walk", speed_m_s, heading_deg, Mode::tracking);
      EXPECT_EQ(broken_in(*build_stage(spec, stock_library())), "") << speed_m_s << " " << heading_deg;
    }
}

TEST(Possible, DynamicRunsStayUpAndNearTheirTargets) {
  for (const char* name : {"human", "mech", "quadruped"})
    for (const double speed_m_s : {2.0, 2.7, 4.0}) expect_to_stay_up(name, "run", speed_m_s, 0.0);
}

// Hips that are moved for balance come too far from a foot that is about to land; they go down for it, as for one that
// stands, or its knee would be straight within one frame.
TEST(Possible, KneesOfLandingLegsDoNotSnapStraight) {
  for (const char* name : {"human", "mech"}) {
    const Made made(walking(name, 1.4, Mode::dynamic));
    const Character& character = *made.stage.character;
    for (const char* knee : {"leg_left/knee", "leg_right/knee"}) {
      const int coord = character.joint(character.find_joint(knee)).coord;
      const auto angle = [&](int f) { return made.motion.row(f)[static_cast<std::size_t>(coord)]; };
      double most = 0.0;
      for (int f = 1; f + 1 < made.motion.frame_count; ++f)
        most = std::max(most, std::fabs(angle(f + 1) - 2.0 * angle(f) + angle(f - 1)));
      EXPECT_LT(most * kDegPerRad, 8.0) << name << " " << knee;
    }
  }
}

// A foot that swings turns about the hip at several rad/s, and its rates are half a tick old.
TEST(Possible, ASwingingFootKeepsToItsPath) {
  for (const double speed_m_s : {0.9, 1.2}) {
    Spec spec = walking("human", speed_m_s, Mode::tracking);
    spec.dynamics.ticks_per_frame = 2;
    const Stage stage = built_stage(spec);
    const Motion motion = generate(stage);
    const int count = stage.character->coord_count();
    std::vector<Rigid> own(stage.character->joints().size()), wanted(own.size());
    double farthest_m = 0.0;
    for (std::size_t f = 0; f < motion.root.size(); ++f) {
      const std::span target(&motion.response.target_coords[f * static_cast<std::size_t>(count)],
                             static_cast<std::size_t>(count));
      forward_kinematics(*stage.character, motion.root[f], motion.row(static_cast<int>(f)), own);
      forward_kinematics(*stage.character, motion.response.target_root[f], target, wanted);
      for (const Sole& sole : stage.dynamics->figure.soles) {
        const auto link = static_cast<std::size_t>(sole.link);
        farthest_m = std::max(farthest_m, length(own[link].p_m - wanted[link].p_m));
      }
    }
    EXPECT_LT(farthest_m, 6e-3) << speed_m_s;
  }
}

// A start and a stop for 3 m/s take longer than a second: with less time the figure jogs, on a foot at any time.
TEST(Possible, ARunOnAShortWayIsOnlyAsFastAsItsStartAndStopAllow) {
  for (const char* name : {"human", "mech"}) {
    Spec spec;
    spec.character.name = name;
    spec.sequences = {sequence({use("run", "waist", 0, 90, {{"speed_m_s", 3.0}})})};
    spec.hold_frames = 30;
    spec.dynamics.mode = Mode::dynamic;
    const Followed run = followed(spec);
    EXPECT_TRUE(run.stood) << name;
    EXPECT_LT(run.farthest_m, 0.03) << name;
    const Motion motion = generate(built_stage(spec));
    EXPECT_GT(motion.root.back().p_m.z - motion.root[0].p_m.z, 0.05) << name;
    EXPECT_FALSE(intent_of(built_stage(spec)).unmet.empty()) << name;
  }
}

Spec with_both_legs_raised() {
  Spec spec;
  spec.character.name = "human";
  spec.hold_frames = 120;
  spec.dynamics.mode = Mode::dynamic;
  spec.sequences = {sequence({use("pose", "leg_left", 0, 120, {{"hip_flex_deg", 80.0}, {"knee_deg", 90.0}}),
                              use("pose", "leg_right", 0, 120, {{"hip_flex_deg", 80.0}, {"knee_deg", 90.0}})})};
  return spec;
}

// A pose lifts both feet until the end. The ground cannot hold that, so one foot stays where it stands.
TEST(Possible, AFigureThatLiftsBothFeetKeepsOneOnTheGround) {
  const Motion motion = generate(built_stage(with_both_legs_raised()));
  for (const Stance& stance : motion.response.stances) EXPECT_EQ(stance.footing, Footing::standing);
}

TEST(Possible, AFigureThatIsThrownUpFallsOntoTheGroundAndNotThroughIt) {
  Spec spec = with_both_legs_raised();
  spec.dynamics.impacts = {{20, "waist", "", Vec3(0.0), Vec3(0.0, 300.0, 30.0)}};
  const Motion motion = generate(built_stage(spec));
  EXPECT_EQ(motion.response.stances.back().footing, Footing::fallen);
  for (std::size_t f = 0; f < motion.root.size(); ++f) ASSERT_GT(motion.root[f].p_m.y, 0.0) << f;
}

// Without forces from outside, the cubics of tracking follow the target exactly.
TEST(Possible, AFigureOnWhichNothingActsStaysOnItsTarget) {
  Spec spec;
  spec.character.name = "human";
  spec.dynamics.mode = Mode::dynamic;
  spec.hold_frames = 30;
  spec.sequences = {sequence({use("pose", "arm_left", 0, 90, {{"elbow_deg", 70.0}})})};
  const Motion motion = generate(built_stage(spec));
  double farthest = 0.0;
  for (std::size_t i = 0; i < motion.coords.size(); ++i)
    farthest = std::max(farthest, std::fabs(motion.coords[i] - motion.response.target_coords[i]));
  EXPECT_LT(farthest, 0.5 * kRadPerDeg);
}

// The hips sway away from the lifted foot. A leg that had to keep its foot in place became straight within a frame.
TEST(Possible, AKneeInTheAirDoesNotSnapStraight) {
  Spec spec;
  spec.character.name = "human";
  spec.dynamics.mode = Mode::tracking;
  ActionUse reach = use("reach", "leg_left", 0, 81, {{"target_m", Vec3(0.64, 1.48, -0.44)}});
  reach.blend_in_frames = -1;
  spec.sequences = {sequence({reach})};
  const Stage stage = built_stage(spec);
  const Motion motion = generate(stage);
  const auto coord = static_cast<std::size_t>(fixtures::joint(*stage.character, "leg_left/knee").coord);
  const auto angle = [&](int f) {
    return motion.response.target_coords[static_cast<std::size_t>(f * motion.coord_count) + coord];
  };
  double most = 0.0;
  for (int f = 1; f + 1 < motion.frame_count; ++f)
    most = std::max(most, std::fabs(angle(f + 1) - 2.0 * angle(f) + angle(f - 1)));
  EXPECT_LT(most * motion.rate_hz * motion.rate_hz, 200.0);
}

// Semi-implicit Euler would carry a joint past its target by half a step of its speed, 0.2 degrees and more.
TEST(Possible, AJointThatHasArrivedIsWhereItsTargetIs) {
  Spec spec;
  spec.character.name = "quadruped";
  spec.dynamics.mode = Mode::tracking;
  spec.hold_frames = 30;
  ActionUse aim = use("aim", "head", 0, 60, {{"target_m", Vec3(1.0, 1.2, 1.5)}});
  aim.blend_in_frames = -1, aim.params["point"] = std::string("face");
  spec.sequences = {sequence({aim})};
  const Stage stage = built_stage(spec);
  const Motion motion = generate(stage);
  const auto coord = static_cast<std::size_t>(fixtures::joint(*stage.character, "head/neck_lat").coord);
  const auto first = static_cast<std::size_t>(40 * motion.coord_count) + coord;
  EXPECT_GT(std::fabs(motion.response.target_coords[first]), 5.0 * kRadPerDeg) << "it has turned";
  EXPECT_NEAR(motion.coords[first], motion.response.target_coords[first], 0.03 * kRadPerDeg);
}

// The first joint of the tail twists by 14.4 of 15 degrees. It slowed down 0.1 s before the end of its range, although
// its target, which stays inside, slows down later, and was 1.5 degrees behind.
TEST(Possible, AJointNearTheEndOfItsRangeArrivesWithItsTarget) {
  Spec spec;
  spec.character.name = "quadruped";
  spec.dynamics.mode = Mode::tracking;
  spec.hold_frames = 30;
  ActionUse aim = use("aim", "tail", 0, 88, {{"target_m", Vec3(-4.61, 0.45, 0.43)}});
  aim.params["point"] = std::string("tip");
  spec.sequences = {sequence({aim})};
  const Stage stage = built_stage(spec);
  const Motion motion = generate(stage);
  const auto coord = static_cast<std::size_t>(fixtures::joint(*stage.character, "tail/tail_1").coord);
  double farthest = 0.0, twist = 0.0;
  for (int f = 0; f < motion.frame_count; ++f)
    for (std::size_t k = 0; k < 4; ++k) {
      const double wanted = motion.response.target_coords[static_cast<std::size_t>(f * motion.coord_count) + coord + k];
      farthest = std::max(farthest, std::fabs(motion.row(f)[coord + k] - wanted));
      if (k == 3) twist = std::max(twist, 2.0 * wanted);
    }
  EXPECT_GT(twist, 14.0 * kRadPerDeg);
  EXPECT_LT(2.0 * farthest, 0.4 * kRadPerDeg);
}

TEST(SoftHeight, ADipBecomesSoftAndNothingRises) {
  std::vector<double> dip(120, 1.0);
  for (int f = 55; f <= 65; ++f) dip[static_cast<std::size_t>(f)] = 0.95;
  const std::vector<double> soft = without_jolts(dip, std::vector<char>(dip.size(), 0), 60.0);
  double hardest = 0.0;
  for (std::size_t f = 1; f + 1 < dip.size(); ++f) {
    EXPECT_LE(soft[f], dip[f] + 1e-12) << f;
    hardest = std::max(hardest, 3600.0 * std::fabs(soft[f + 1] - 2.0 * soft[f] + soft[f - 1]));
  }
  EXPECT_LT(hardest, 10.0);  // the dip has 180 m/s^2
  EXPECT_EQ(soft.front(), 1.0);
}

TEST(SoftHeight, SlowMotionsAndKeptFramesStayBitByBit) {
  std::vector<double> slow, dip(120, 1.0);
  for (int f = 0; f < 120; ++f) slow.push_back(1.0 + 1e-4 * f);
  dip[60] = 0.95;
  EXPECT_EQ(without_jolts(slow, std::vector<char>(120, 0), 60.0), slow);
  EXPECT_EQ(without_jolts(dip, std::vector<char>(120, 1), 60.0), dip);
}

TEST(SupportHull, APointInsideStaysAndOthersComeToTheInset) {
  HullScratch hull;
  std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  EXPECT_EQ(nearest_inside(square, 0.1, Vec3(0.5, 3.0, 0.2), hull), Vec3(0.5, 3.0, 0.2));
  EXPECT_LT(length(nearest_inside(square, 0.1, Vec3(0.5, 3.0, -2.0), hull) - Vec3(0.5, 3.0, 0.1)), 1e-12);
  EXPECT_LT(length(nearest_inside(square, 0.1, Vec3(7.0, 0.0, 7.0), hull) - Vec3(0.9, 0.0, 0.9)), 1e-12);
}

TEST(SupportHull, ANarrowHullGivesWay) {
  HullScratch hull;
  std::vector<Vec3> edge = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_LT(length(nearest_inside(edge, 0.1, Vec3(0.4, 0.0, 2.0), hull) - Vec3(0.4, 0.0, 0.0)), 1e-12);
  std::vector<Vec3> point = {{0.3, 0, 0.2}};
  EXPECT_LT(length(nearest_inside(point, 0.1, Vec3(0.4, 0.0, 2.0), hull) - Vec3(0.3, 0.0, 0.2)), 1e-12);
}

}  // namespace
}  // namespace contort
