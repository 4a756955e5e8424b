#include "generator/dynamics/standing.h"

#include <algorithm>

#include "generator/dynamics/strength.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kEdge_m = 0.005;  // of the zero moment point from the edge, for which tracking gives way
constexpr double kTips_m = 0.03;   // the zero moment point this far outside cannot be brought back
constexpr double kTips_s = 0.2;    // nor one that is outside for so long

}  // namespace

void Standing::begin(const DynamicFigure& figure, double tick_s) {
  tick_s_ = tick_s;
  outside_s_ = 0.0;
  control_.begin(figure, tick_s);
  hold_.assign(at(figure.body.dof_count()));
}

void Standing::let_go() {
  control_.rest();
  outside_s_ = 0.0;
}

void Standing::find_ground(const EquationOfMotion& equation, const FootContacts& contacts, Actuation& actuation) {
  find_support_area(*equation.figure, contacts.feet().soles(), equation.dynamics, area_);
  ground_.prepare(*equation.figure, contacts.feet().soles(), contacts.firmness(), equation.dynamics);
  ground_.efforts(*equation.figure, equation.dynamics, actuation.forces, actuation.efforts);
}

Balance Standing::balance(const EquationOfMotion& equation, std::span<const double> forces) const {
  return balance_of(area_, equation.dynamics, forces, equation.weight_N());
}

void Standing::keep(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted,
                    Actuation& actuation) {
  contacts.find_rows(equation);
  std::ranges::copy(wanted, actuation.acceleration.begin());
  contacts.keep(actuation.acceleration);
  equation.find_forces(actuation.acceleration, actuation.forces);
}

bool Standing::stand(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted,
                     Recorder& record, Actuation& actuation) {
  keep(equation, contacts, wanted, actuation);
  find_ground(equation, contacts, actuation);
  control_.correct({*equation.figure, equation.dynamics, equation.mass, contacts.feet().stands_by_dof(),
                    contacts.support(), area_, ground_, equation.weight_N(), actuation.acceleration, actuation.forces});
  ground_.efforts(*equation.figure, equation.dynamics, actuation.forces, actuation.efforts);
  if (needs_too_much(equation, actuation, contacts.has_soles())) hold_back(equation, contacts, record, actuation);
  if (!contacts.has_soles()) return true;
  const Balance reached = balance(equation, actuation.forces);
  record.balance(reached);
  outside_s_ = reached.margin_m < 0.0 ? outside_s_ + tick_s_ : 0.0;
  return reached.margin_m > -kTips_m && outside_s_ < kTips_s;
}

bool Standing::needs_too_much(const EquationOfMotion& equation, const Actuation& actuation, bool has_soles) const {
  return (has_soles && balance(equation, actuation.forces).margin_m < kEdge_m) ||
         exceeds_strength(*equation.figure, actuation.efforts);
}

// Back towards holding still, as far as joints and ground cannot give more.
void Standing::hold_back(EquationOfMotion& equation, FootContacts& contacts, Recorder& record, Actuation& actuation) {
  const DynamicFigure& figure = *equation.figure;
  std::ranges::fill(hold_.acceleration, 0.0);
  contacts.keep(hold_.acceleration);
  equation.find_forces(hold_.acceleration, hold_.forces);
  ground_.efforts(figure, equation.dynamics, hold_.forces, hold_.efforts);
  take_back(hold_, std::min(affordable_share(figure, hold_.efforts, actuation.efforts),
                            balanced_share(area_, hold_.forces, actuation.forces, kEdge_m)),
            actuation);
  equation.find_forces(actuation.acceleration, actuation.forces);
  ground_.efforts(figure, equation.dynamics, actuation.forces, actuation.efforts);
  if (!exceeds_strength(figure, actuation.efforts)) return;
  record.overpowered();
  record.efforts(actuation.efforts);
  give_way(equation, contacts, actuation);
}

// If even holding still is too much for a joint, joints give what they have and the rest follows.
void Standing::give_way(EquationOfMotion& equation, FootContacts& contacts, Actuation& actuation) {
  clamp_to_strength(*equation.figure, actuation.efforts);
  equation.find_factors();
  for (std::size_t k = 0; k < equation.size(); ++k)
    actuation.acceleration[k] = actuation.efforts[k] - equation.bias[k];
  respond(equation.body(), equation.factors, contacts.support(), contacts.support().wanted, response_,
          actuation.acceleration);
  equation.find_forces(actuation.acceleration, actuation.forces);
}

bool Standing::could_stand(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted,
                           Actuation& actuation) {
  keep(equation, contacts, wanted, actuation);
  find_support_area(*equation.figure, contacts.feet().soles(), equation.dynamics, area_);
  return !(balance(equation, actuation.forces).margin_m < 0.0);
}

}  // namespace contort
