// Bodies of a figure that come near each other: arms that swing stop before they reach the trunk and the thighs.
#include "generator/dynamics/body_contacts.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "generator/built_in.h"
#include "generator/dynamics/contact_solver.h"
#include "generator/dynamics/loose.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

constexpr double kBodyTick_s = 1.0 / 120.0;
constexpr double kLook_m = 0.15;

// The least gap between any two bodies of the human that must not touch.
double least_gap_of(const Rigid& root, std::span<const double> coords) {
  const Character& human = fixtures::human();
  std::vector<Rigid> world(human.joints().size());
  forward_kinematics(human, root, coords, world);
  double least_m = 1.0;
  for (const ColliderPair& pair : human.judged_colliders()) {
    const auto solid = [&](int collider) {
      const Collider& own = human.colliders()[static_cast<std::size_t>(collider)];
      return moved(world[static_cast<std::size_t>(own.joint)], solid_of(own));
    };
    least_m = std::min(least_m, signed_distance(solid(pair.a), solid(pair.b), kLook_m));
  }
  return least_m;
}

struct HumanWithBodies {
  HumanWithBodies() {
    stage = fixtures::stage_of({});
    figure = build_figure(fixtures::human(), stage.legs, {});
    equation.begin(figure, moving_start(figure.body, TargetMotion(figure.body, generate(stage))));
    bodies.begin(fixtures::human(), figure);
    place();
  }
  void place() {
    equation.place();
    equation.find_mass();
    equation.find_factors();
    bodies.find(equation.dynamics, kLook_m, false);
  }
  std::size_t dof(const std::string& joint) const {
    const int found = fixtures::human().find_joint(joint);
    return static_cast<std::size_t>(figure.body.links()[static_cast<std::size_t>(found)].dof);
  }
  double least_gap_m() const { return least_gap_of(equation.state.root, equation.state.coords); }
  void move() {
    integrate(figure.body, equation.state.velocity, kBodyTick_s, equation.state.root, equation.state.coords);
  }

  Stage stage;
  DynamicFigure figure;
  EquationOfMotion equation;
  BodyContacts bodies;
};

// Rates of the joints of both arms, in steps of 0.01 rad/s.
void draw_arm_rates(const HumanWithBodies& human, std::span<double> rates) {
  for (const std::string joint : {"arm_left/shoulder", "arm_right/shoulder"})
    for (std::size_t k = 0; k < 3; ++k) rates[human.dof(joint) + k] = 0.01 * *rc::gen::inRange(-600, 601);
  for (const std::string joint : {"arm_left/elbow", "arm_right/elbow"})
    rates[human.dof(joint)] = 0.01 * *rc::gen::inRange(0, 601);
}

TEST(BodyContacts, AreTheGapsOfTheSolids) {
  HumanWithBodies human;
  double least_m = 1.0;
  for (const BodyContact& contact : human.bodies.contacts()) {
    EXPECT_NE(contact.link_a, contact.link_b);
    EXPECT_NEAR(length(contact.normal), 1.0, 1e-9);
    least_m = std::min(least_m, contact.gap_m);
  }
  EXPECT_NEAR(least_m, human.least_gap_m(), 1e-9);
}

RC_GTEST_PROP(BodyContacts, NoSwingOfTheArmsGoesThroughABody, ()) {
  HumanWithBodies human;
  for (int tick = 0; tick < 40; ++tick) {
    if (tick % 10 == 0) draw_arm_rates(human, human.equation.state.velocity);
    human.place();
    human.bodies.stop(human.equation, kBodyTick_s, human.equation.state.velocity);
    human.move();
    RC_ASSERT(human.least_gap_m() > -0.02);  // a tick turns an arm by up to 5 degrees
  }
}

// A blow acts for 1.5 s; a figure that fell because of it continues to fall and lie.
TEST(BodyContacts, KeepBodiesApartAlsoLongAfterTheBlow) {
  Spec spec;
  spec.character.name = "human", spec.dynamics.mode = Mode::dynamic, spec.hold_frames = 240;
  ImpactDesc blow;
  blow.slot = "torso", blow.impulse_N_s = Vec3(90.0, 0.0, -90.0);
  spec.dynamics.impacts = {blow};
  spec.sequences.push_back({"", 0, {{}}});
  BuiltInGenerator generator(stock_library());
  const Result<Execution> made = execute(generator, spec);
  ASSERT_TRUE(made) << to_line(made.issue());
  EXPECT_EQ(made->motion.response.stances.back().footing, Footing::fallen);
  double least_m = 1.0;
  for (int frame = 0; frame < made->motion.frame_count; ++frame)
    least_m =
        std::min(least_m, least_gap_of(made->motion.root[static_cast<std::size_t>(frame)], made->motion.row(frame)));
  EXPECT_GT(least_m, -0.02);
}

RC_GTEST_PROP(BodyContacts, ChangeNeitherTheTrunkNorTheLegs, ()) {
  HumanWithBodies human;
  std::vector<double>& rates = human.equation.state.velocity;
  for (double& rate : rates) rate = 0.01 * *rc::gen::inRange(-600, 601);
  const std::vector<double> before = rates;
  human.bodies.stop(human.equation, kBodyTick_s, rates);
  for (int i = 0; i < kRootDofs; ++i)
    RC_ASSERT(rates[static_cast<std::size_t>(i)] == before[static_cast<std::size_t>(i)]);
  for (const int dof : human.figure.watched)
    RC_ASSERT(rates[static_cast<std::size_t>(dof)] == before[static_cast<std::size_t>(dof)]);
  for (const Sole& sole : human.figure.soles)
    for (const int dof : sole.leg_dofs)
      RC_ASSERT(rates[static_cast<std::size_t>(dof)] == before[static_cast<std::size_t>(dof)]);
}

TEST(BodyContacts, SlowAnArmDownThatWouldArriveAndNoOther) {
  HumanWithBodies human;
  const std::size_t swing = human.dof("arm_left/shoulder");
  const auto slowed = [&](double rate) {
    std::vector<double> acceleration(human.equation.size(), 0.0);
    std::ranges::fill(human.equation.state.velocity, 0.0);
    human.equation.state.velocity[swing + 2] = rate;
    human.bodies.slow(human.equation, 0.1, acceleration);
    return acceleration[swing + 2];
  };
  const double towards = slowed(-5.0), away = slowed(5.0);
  EXPECT_TRUE((towards > 1.0 && away == 0.0) || (away < -1.0 && towards == 0.0)) << towards << " " << away;
}

RC_GTEST_PROP(BodyContacts, TwoBodiesOfALooseFigurePartWithoutAChangeOfItsMomentum, ()) {
  HumanWithBodies human;
  std::vector<double>& velocity = human.equation.state.velocity;
  for (double& rate : velocity) rate = 0.01 * *rc::gen::inRange(-300, 301);
  const auto momentum = [&] {
    return momentum_of(human.figure.body, human.equation.dynamics, human.equation.mass, velocity);
  };
  const SpatialForce before = momentum();
  ContactSolver solver;
  solver.begin(human.equation, false);
  for (const BodyContact& contact : human.bodies.contacts()) solver.add_pair(contact, 0.0);
  solver.solve(velocity);
  RC_ASSERT(length(momentum().force - before.force) < 1e-9);
  RC_ASSERT(length(momentum().moment - before.moment) < 1e-9);
  RC_ASSERT(!solver.pushes(true) && !solver.pushes(false));  // without any force from the ground
  for (const BodyContact& contact : human.bodies.contacts()) {
    double opens = 0.0;
    for_openings(human.figure.body, human.equation.dynamics, contact,
                 [&](std::size_t dof, double share) { opens += share * velocity[dof]; });
    RC_ASSERT(opens > -0.05);
  }
}

}  // namespace
}  // namespace contort
