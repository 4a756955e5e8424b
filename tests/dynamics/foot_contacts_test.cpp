// Contacts of soles, impacts and a figure that lets go, each by itself, on a human that stands at rest.
#include "generator/dynamics/foot_contacts.h"

#include <gtest/gtest.h>

#include "generator/dynamics/impact_response.h"
#include "generator/dynamics/loose_motion.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

const Environment kLevelGround;

constexpr double kContactTick_s = 1.0 / 120.0;

// Both soles stand in frames 0 and 1, only sole 0 in frame 2, none in frame 3.
Motion lifting_feet(const Stage& stage) {
  Motion motion = generate(stage);
  const Rigid root = motion.root[0];
  const std::vector<double> rest(motion.row(0).begin(), motion.row(0).end());
  motion.frame_count = 4;
  motion.root.assign(4, root);
  motion.coords.clear();
  for (int f = 0; f < 4; ++f) motion.coords.insert(motion.coords.end(), rest.begin(), rest.end());
  motion.row(2)[static_cast<std::size_t>(fixtures::joint(fixtures::human(), "leg_right/knee").coord)] += 1.0;
  motion.root[3].p_m.y += 0.2;
  return motion;
}

struct StandingHuman {
  StandingHuman() {
    stage = fixtures::stage_of({});
    figure = build_figure(fixtures::human(), stage.legs, {});
    const TargetMotion target(figure.body, generate(stage));
    equation.begin(figure, moving_start(figure.body, target));
    plan = ContactPlan(fixtures::human(), figure, kLevelGround, lifting_feet(stage));
    contacts.begin(figure, kLevelGround, plan, 60.0, 1.0 / 120.0);
    place();
  }
  void place() {
    equation.place();
    equation.find_mass();
    equation.find_factors();
  }
  void follow(int frame) {
    contacts.begin_frame(frame);
    contacts.follow_plan(frame, equation.dynamics);
  }
  void land() {
    contacts.lead_all();
    follow(0);
    contacts.find_rows(equation, equation.still);
  }
  // The greatest speed of a guided sole in the directions of its rows.
  double sole_speed() {
    std::vector<double> speeds(static_cast<std::size_t>(contacts.support().count));
    soles_moved_by(contacts.support(), equation.state.velocity, speeds);
    double most = 0.0;
    for (const double v : speeds) most = std::max(most, std::fabs(v));
    return most;
  }
  SpatialForce momentum() const {
    return momentum_of(figure.body, equation.dynamics, equation.mass, equation.state.velocity);
  }

  Stage stage;
  DynamicFigure figure;
  EquationOfMotion equation;
  ContactPlan plan;
  FootContacts contacts;
};

Impact blow_on(const char* joint_name, const Vec3& impulse_N_s) {
  return {0, static_cast<int>(&fixtures::joint(fixtures::human(), joint_name) - fixtures::human().joints().data()),
          Vec3(0.0), impulse_N_s};
}

TEST(ContactPlan, SolesGoOnAtItsEndsAsTheyGoBesideThem) {
  const Stage stage = fixtures::stage_of({});
  Motion motion = lifting_feet(stage);
  for (int f = 0; f < 4; ++f) motion.root[static_cast<std::size_t>(f)].p_m = Vec3(0.0, 1.0, 0.01 * f);
  const ContactPlan plan(fixtures::human(), build_figure(fixtures::human(), stage.legs, {}), kLevelGround, motion);
  for (const double frame : {-0.25, 0.0, 3.0, 3.25})
    EXPECT_NEAR(plan.sole_at(frame, 0).linear.z, 0.01 * motion.rate_hz, 1e-9) << frame;
}

TEST(ContactPlan, CountsTheFramesToWhereASoleBears) {
  const Stage stage = fixtures::stage_of({});
  const ContactPlan plan(fixtures::human(), build_figure(fixtures::human(), stage.legs, {}), kLevelGround,
                         lifting_feet(stage));
  EXPECT_EQ(plan.airborne(1, 1), 0);
  EXPECT_EQ(plan.airborne(2, 1), 1);
  EXPECT_EQ(plan.airborne(3, 1), 2);
}

TEST(ContactPlan, ASoleThatNeverBearsIsAirborneForAllFrames) {
  const Stage stage = fixtures::stage_of({});
  Motion motion = lifting_feet(stage);
  for (Rigid& root : motion.root) root.p_m.y += 1.0;
  const ContactPlan plan(fixtures::human(), build_figure(fixtures::human(), stage.legs, {}), kLevelGround, motion);
  for (int frame = 0; frame < 4; ++frame) EXPECT_EQ(plan.airborne(frame, 0), 4) << frame;
}

TEST(FootContacts, SolesComeAndGoAsPlanned) {
  StandingHuman human;
  human.follow(0);
  EXPECT_TRUE(human.contacts.feet().none()) << "nothing is led yet";
  human.contacts.lead_all();
  for (const int frame : {0, 1}) {
    human.follow(frame);
    EXPECT_EQ(human.contacts.feet().soles().size(), 2u) << frame;
  }
  human.follow(2);
  ASSERT_EQ(human.contacts.feet().soles().size(), 1u);
  EXPECT_EQ(human.contacts.feet().soles()[0], 0);
  human.follow(3);
  EXPECT_TRUE(human.contacts.feet().none());
  human.follow(0);
  human.contacts.release();
  EXPECT_TRUE(human.contacts.feet().none());
}

TEST(FootContacts, ASoleThatIsHighBearsNothingYet) {
  StandingHuman human;
  human.contacts.lead_all();
  human.equation.state.root.p_m.y += 0.05;
  human.place();
  human.follow(0);
  EXPECT_TRUE(human.contacts.feet().none());
}

TEST(FootContacts, ASoleInTheAirIsLedAsInThePlan) {
  StandingHuman human;
  human.contacts.lead_all();
  human.follow(2);
  human.contacts.find_rows(human.equation, human.equation.still);
  EXPECT_EQ(human.contacts.support().count, 12);
  EXPECT_EQ(human.contacts.swinging(human.figure.soles[1].leg_dofs[0]), 1);
  EXPECT_EQ(human.contacts.swinging(human.figure.soles[0].leg_dofs[0]), -1);
}

TEST(ContactPlan, BetweenFramesASolePassesThroughBothWithoutAJump) {
  StandingHuman human;
  const SoleMotion before = human.plan.sole_at(2.0 - 1e-9, 1), after = human.plan.sole_at(2.0 + 1e-9, 1);
  EXPECT_LT(length(before.world_from_sole.p_m - human.plan.sole(2, 1).p_m), 1e-7);
  EXPECT_LT(length(before.linear - after.linear), 1e-5);
  EXPECT_LT(length(before.angular - after.angular), 1e-5);
  const double h = 1e-6;
  const SoleMotion a = human.plan.sole_at(1.5, 1), b = human.plan.sole_at(1.5 + h, 1);
  EXPECT_LT(length((b.world_from_sole.p_m - a.world_from_sole.p_m) / (h / 60.0) - a.linear), 1e-3);
}

TEST(FootContacts, ASoleIsLessFirmBeforeItIsLifted) {
  StandingHuman human;
  human.contacts.begin_frame(1);
  EXPECT_LT(human.contacts.firmness()[1], human.contacts.firmness()[0]);
}

TEST(FootContacts, OnlySolesThatLieStillLandByThemselves) {
  StandingHuman human;
  human.equation.state.velocity[1] = 1.0;  // upwards, m/s
  human.equation.find_bias();
  EXPECT_FALSE(human.contacts.land_flat(0.0, human.equation.dynamics));
  human.equation.state.velocity[1] = 0.0;
  human.equation.find_bias();
  EXPECT_TRUE(human.contacts.land_flat(0.0, human.equation.dynamics));
}

TEST(FootContacts, StoppedSolesDoNotMove) {
  StandingHuman human;
  for (double& v : human.equation.state.velocity) v = 0.2;
  human.land();
  EXPECT_GT(human.sole_speed(), 0.1);
  human.contacts.stop(human.equation);
  EXPECT_LT(human.sole_speed(), 1e-6);
}

TEST(ImpactResponse, ASoftBlowMovesAStandingFigureAndNotItsSoles) {
  StandingHuman human;
  human.land();
  ImpactResponse impact;
  impact.strike(human.equation, human.contacts, kLevelGround, blow_on("arm_left/shoulder", {2.0, 0.0, -4.0}));
  EXPECT_LT(impact.sole_speed_m_s(), 1e-3);
  EXPECT_LT(human.momentum().force.z, -0.1);
}

TEST(ImpactResponse, TheGroundTakesLittleOfAHardBlow) {
  double before_N_s = 0.0;
  for (const double blow_N_s : {8.0, 30.0, 100.0, 300.0, 1000.0}) {
    StandingHuman human;
    human.land();
    ImpactResponse impact;
    impact.strike(human.equation, human.contacts, kLevelGround, blow_on("torso/lumbar_rot", {blow_N_s, 0.0, 0.0}));
    const double kept_N_s = human.momentum().force.x;
    EXPECT_GT(kept_N_s, before_N_s) << blow_N_s;
    // The friction of the weight in 0.05 s, and of the blow's own pressure on one side.
    EXPECT_GE(kept_N_s, 0.9 * blow_N_s - kFriction * 0.05 * human.equation.weight_N()) << blow_N_s;
    before_N_s = kept_N_s;
  }
}

TEST(ImpactResponse, AMirroredBlowGivesTheMirroredMotion) {
  Vec3 kept[2];
  for (const int side : {0, 1}) {
    StandingHuman human;
    human.land();
    ImpactResponse impact;
    impact.strike(
        human.equation, human.contacts, kLevelGround,
        blow_on(side == 0 ? "arm_left/shoulder" : "arm_right/shoulder", {side == 0 ? 40.0 : -40.0, 0, -20.0}));
    kept[side] = human.momentum().force;
  }
  EXPECT_NEAR(kept[0].x, -kept[1].x, 1e-2);
  EXPECT_NEAR(kept[0].z, kept[1].z, 1e-2);
}

TEST(ImpactResponse, SolesArePushedAndNotPulled) {
  StandingHuman human;
  human.land();
  ImpactResponse impact;
  impact.strike(human.equation, human.contacts, kLevelGround, blow_on("torso/lumbar_rot", {0.0, 200.0, 0.0}));
  EXPECT_GE(human.momentum().force.y, 200.0 - 0.05 * human.equation.weight_N() - 1e-6);
  EXPECT_GT(impact.sole_speed_m_s(), 0.5) << "it was lifted";
}

TEST(ImpactResponse, AFreeFigureTakesAllOfTheImpulse) {
  StandingHuman human;
  ImpactResponse impact;
  const Impact blow = blow_on("arm_left/shoulder", {30.0, 10.0, -40.0});
  impact.strike(human.equation, human.contacts, kLevelGround, blow);
  EXPECT_LT(length(human.momentum().force - blow.impulse_N_s), 1e-9);
}

TEST(LooseMotion, AFigureInTheAirFallsWithGravityAndTouchesNothing) {
  StandingHuman human;
  human.equation.state.root.p_m.y += 1.0;
  human.place();
  LooseMotion loose;
  loose.begin(kContactTick_s);
  EXPECT_FALSE(loose.is_loose());
  loose.let_go();
  EXPECT_TRUE(loose.is_loose());
  Actuation actuation;
  actuation.assign(human.equation.size());
  loose.fall(human.equation, std::vector<double>(human.equation.size(), 0.0), actuation);
  EXPECT_NEAR(actuation.acceleration[1], -kGravity_m_s2, 1e-9);
  const std::vector<TouchPoint> touches = touch_points(fixtures::human(), human.figure);
  loose.move(fixtures::human(), human.equation, touches, {}, kLevelGround, human.momentum());
  EXPECT_NEAR(human.momentum().force.y, -human.equation.weight_N() * kContactTick_s, 1e-9);
  const Quat upright = human.equation.state.root.q;
  EXPECT_EQ(loose.footing(upright, upright), Footing::airborne);
  EXPECT_EQ(loose.footing(axis_angle({1, 0, 0}, 1.2) * upright, upright), Footing::fallen);
  EXPECT_EQ(loose.footing(upright, upright), Footing::fallen);  // permanently
}

}  // namespace
}  // namespace contort
