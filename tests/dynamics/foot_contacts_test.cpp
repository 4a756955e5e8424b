// Contacts of soles, impacts and a figure that lets go, each by itself, on a human that stands at rest.
#include "generator/dynamics/foot_contacts.h"

#include <gtest/gtest.h>

#include "generator/dynamics/impact_response.h"
#include "generator/dynamics/loose_motion.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

const Environment kLevelGround;

// Both soles are planned in frames 0 and 1, only sole 0 in frame 2, none in frame 3.
struct StandingHuman {
  StandingHuman() {
    stage = fixtures::stage_of({});
    figure = build_figure(fixtures::human(), stage.legs, {});
    const TargetMotion target(figure.body, generate(stage));
    equation.begin(figure, standing_start(figure.body, target));
    contacts.begin(figure, kLevelGround, {3, 3, 1, 0}, 60.0);
    place();
  }
  void place() {
    equation.place();
    equation.find_mass();
    equation.find_factors();
  }
  void land() {
    contacts.follow_plan(equation.dynamics, true);
    contacts.find_rows(equation);
  }
  // The greatest speed of a standing sole, of what its rows ask for.
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
  FootContacts contacts;
};

Impact blow_on(const char* joint_name, const Vec3& impulse_N_s) {
  return {0, static_cast<int>(&fixtures::joint(fixtures::human(), joint_name) - fixtures::human().joints().data()),
          Vec3(0.0), impulse_N_s};
}

TEST(FootContacts, SolesComeAndGoAsPlanned) {
  StandingHuman human;
  EXPECT_TRUE(human.contacts.feet().none());
  EXPECT_TRUE(human.contacts.follow_plan(human.equation.dynamics, false));
  EXPECT_EQ(human.contacts.feet().soles().size(), 2u);
  human.contacts.begin_frame(1);
  EXPECT_FALSE(human.contacts.follow_plan(human.equation.dynamics, false));
  human.contacts.begin_frame(2);
  EXPECT_TRUE(human.contacts.follow_plan(human.equation.dynamics, false));
  ASSERT_EQ(human.contacts.feet().soles().size(), 1u);
  EXPECT_EQ(human.contacts.feet().soles()[0], 0);
  human.contacts.begin_frame(3);
  EXPECT_TRUE(human.contacts.follow_plan(human.equation.dynamics, false));
  EXPECT_TRUE(human.contacts.feet().none());
}

TEST(FootContacts, ASoleThatIsHighLandsOnlyWhereItMustAtOnce) {
  StandingHuman human;
  human.equation.state.root.p_m.y += 0.05;
  human.place();
  EXPECT_FALSE(human.contacts.follow_plan(human.equation.dynamics, false));
  EXPECT_TRUE(human.contacts.follow_plan(human.equation.dynamics, true));
  EXPECT_NEAR(human.contacts.feet().places()[0].world_from_sole.p_m.y, 0.0, 1e-12);  // on the ground
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
  EXPECT_FALSE(human.contacts.land_flat(human.equation.dynamics));
  human.equation.state.velocity[1] = 0.0;
  human.equation.find_bias();
  EXPECT_TRUE(human.contacts.land_flat(human.equation.dynamics));
}

TEST(FootContacts, StoppedSolesDoNotMove) {
  StandingHuman human;
  for (double& v : human.equation.state.velocity) v = 0.2;
  human.land();
  EXPECT_GT(human.sole_speed(), 0.1);
  human.contacts.stop(human.equation.state.velocity);
  EXPECT_LT(human.sole_speed(), 1e-6);
}

TEST(ImpactResponse, ABlowOnAStandingFigureMovesItAndNotItsSoles) {
  StandingHuman human;
  human.land();
  ImpactResponse impact;
  const Impact blow = blow_on("arm_left/shoulder", {2.0, 0.0, -4.0});
  impact.find(human.equation, human.contacts, blow);
  EXPECT_FALSE(impact.pulls_a_foot(human.equation, human.contacts));
  impact.apply(human.equation, human.contacts, blow);
  EXPECT_LT(human.sole_speed(), 1e-6);
  EXPECT_LT(human.momentum().force.z, -0.1);
}

TEST(ImpactResponse, ABlowThatLiftsTheFigureWouldHaveToPullItsFeet) {
  StandingHuman human;
  human.land();
  ImpactResponse impact;
  impact.find(human.equation, human.contacts, blow_on("torso/lumbar_rot", {0.0, 1.0, 0.0}));
  EXPECT_FALSE(impact.pulls_a_foot(human.equation, human.contacts));  // its weight holds it for 0.02 s
  impact.find(human.equation, human.contacts, blow_on("torso/lumbar_rot", {0.0, 200.0, 0.0}));
  EXPECT_TRUE(impact.pulls_a_foot(human.equation, human.contacts));
  human.contacts.release();
  impact.find(human.equation, human.contacts, blow_on("torso/lumbar_rot", {0.0, 200.0, 0.0}));
  EXPECT_FALSE(impact.pulls_a_foot(human.equation, human.contacts));  // it has none
}

TEST(ImpactResponse, AFreeFigureTakesAllOfTheImpulse) {
  StandingHuman human;
  ImpactResponse impact;
  const Impact blow = blow_on("arm_left/shoulder", {30.0, 10.0, -40.0});
  impact.find(human.equation, human.contacts, blow);
  impact.apply(human.equation, human.contacts, blow);
  const Vec3 gained = human.momentum().force;
  EXPECT_LT(length(gained - blow.impulse_N_s), 1e-9);
}

TEST(LooseMotion, AFigureInTheAirFallsWithGravityAndTouchesNothing) {
  constexpr double kTick_s = 1.0 / 120.0;
  StandingHuman human;
  human.equation.state.root.p_m.y += 1.0;
  human.place();
  LooseMotion loose;
  loose.begin(human.figure, kTick_s);
  EXPECT_FALSE(loose.is_loose());
  loose.let_go();
  EXPECT_TRUE(loose.is_loose());
  Actuation actuation;
  actuation.assign(human.equation.size());
  loose.fall(human.equation, std::vector<double>(human.equation.size(), 0.0), actuation);
  EXPECT_NEAR(actuation.acceleration[1], -kGravity_m_s2, 1e-9);
  const std::vector<TouchPoint> touches = touch_points(fixtures::human(), human.figure);
  loose.move(human.equation, touches, kLevelGround, human.momentum());
  EXPECT_NEAR(human.momentum().force.y, -human.equation.weight_N() * kTick_s, 1e-9);
  const Quat upright = human.equation.state.root.q;
  EXPECT_EQ(loose.footing(upright, upright), Footing::airborne);
  EXPECT_EQ(loose.footing(axis_angle({1, 0, 0}, 1.2) * upright, upright), Footing::fallen);
  EXPECT_EQ(loose.footing(upright, upright), Footing::fallen);  // for good
}

}  // namespace
}  // namespace contort
