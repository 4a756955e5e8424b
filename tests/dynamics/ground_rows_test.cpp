// Accelerations that the ground's forces can produce.
#include "generator/dynamics/ground_rows.h"

#include <gtest/gtest.h>

#include "generator/dynamics/foot_contacts.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

const Environment kFlatGround;

// A human that stands, with accelerations of its trunk and arms that would tip it.
struct Leaning {
  Leaning() {
    Spec spec;
    spec.character.name = "human";
    spec.dynamics.mode = Mode::dynamic;  // on bent knees, because straight ones could not change the pressure
    stage = *build_stage(spec, stock_library());
    stage.dynamics = nullptr;
    figure = build_figure(fixtures::human(), stage.legs, {});
    const Motion motion = generate(stage);
    plan = ContactPlan(fixtures::human(), figure, kFlatGround, motion);
    equation.begin(figure, moving_start(figure.body, TargetMotion(figure.body, motion)));
    contacts.begin(figure, kFlatGround, plan, 60.0, 1.0 / 120.0);
    equation.place();
    equation.find_mass();
    contacts.lead_all();
    contacts.follow_plan(0.0, equation.dynamics);
    contacts.find_rows(equation, equation.still);
    actuation.assign(equation.size());
    for (std::size_t k = kRootDofs; k < equation.size(); ++k) actuation.acceleration[k] = k % 2 == 0 ? 9.0 : -4.0;
    contacts.keep(actuation.acceleration);
    equation.find_forces(actuation.acceleration, actuation.forces);
    find_support_area(figure, contacts.feet(), 0.0, equation.dynamics, area);
    share.prepare(figure, contacts.feet(), contacts.firmness(), equation.dynamics);
  }
  Balance balance() const { return balance_of(area, equation.dynamics, actuation.forces, equation.weight_N()); }
  double sole_error() {
    std::vector<double> moved(contacts.support().wanted.size());
    soles_moved_by(contacts.support(), actuation.acceleration, moved);
    double most = 0.0;
    for (std::size_t r = 0; r < moved.size(); ++r)
      most = std::max(most, std::fabs(moved[r] - contacts.support().wanted[r]));
    return most;
  }

  Stage stage;
  DynamicFigure figure;
  ContactPlan plan;
  EquationOfMotion equation;
  FootContacts contacts;
  Actuation actuation;
  SupportArea area;
  GroundShare share;
  GroundControl control;
  std::vector<GroundRow> rows;
};

TEST(GroundRows, TheZeroMomentPointIsPutWhereItShallBeAndSolesStay) {
  Leaning human;
  const Vec3 wanted(0.02, 0.0, 0.06);
  ASSERT_GT(length(human.balance().zmp_m - wanted), 0.02);
  add_zmp_rows(human.equation.dynamics.world[0], wanted, human.rows);
  human.control.meet(human.equation, human.contacts.ease(), human.rows, human.contacts.support(), human.actuation);
  EXPECT_LT(length(human.balance().zmp_m - wanted), 1e-6);
  EXPECT_LT(human.sole_error(), 1e-6);
}

TEST(GroundRows, InFlightTheGroundGivesNothing) {
  Leaning human;
  human.contacts.release();
  human.contacts.find_rows(human.equation, human.equation.still);
  add_flight_rows(human.rows);
  human.control.meet(human.equation, human.contacts.ease(), human.rows, human.contacts.support(), human.actuation);
  for (std::size_t k = 0; k < kRootDofs; ++k) EXPECT_NEAR(human.actuation.forces[k], 0.0, 1e-6) << k;
}

TEST(GroundRows, PressureIsMetExactlyAndAnEffortSoftly) {
  Leaning human;
  std::vector<double> zeros(human.equation.size(), 0.0), efforts(human.equation.size());
  human.share.efforts(human.equation.dynamics, human.actuation.forces, efforts);
  const int dof = human.figure.body.links()[1].dof;
  const double before = efforts[static_cast<std::size_t>(dof)], wanted = 0.5 * before;
  add_pressure_row(0.8 * human.equation.weight_N(), human.rows);
  add_effort_row(human.share, human.equation.dynamics, dof, wanted, zeros, human.rows);
  human.control.meet(human.equation, human.contacts.ease(), human.rows, human.contacts.support(), human.actuation);
  EXPECT_NEAR(human.actuation.forces[1], 0.8 * human.equation.weight_N(), 1e-6);
  human.share.efforts(human.equation.dynamics, human.actuation.forces, efforts);
  const double after = efforts[static_cast<std::size_t>(dof)];
  EXPECT_LT(std::fabs(after - wanted), 0.5 * std::fabs(before - wanted));
  for (const double zero : zeros) EXPECT_EQ(zero, 0.0);
}

}  // namespace
}  // namespace contort
