#include "generator/dynamics/impact_response.h"

#include "generator/dynamics/linear.h"
#include "generator/dynamics/loose.h"

namespace contort {

namespace {

constexpr double kImpact_s = 0.02;  // how long an impact lasts: a foot holds what the weight presses on it in that time

}  // namespace

void ImpactResponse::find(EquationOfMotion& equation, FootContacts& contacts, const Impact& impact) {
  contacts.find_rows(equation);
  change_.assign(equation.size(), 0.0);
  add_impulse(equation.body(), equation.dynamics, impact, change_);
  SupportRows& support = contacts.support();
  soles_moved_by(support, equation.state.velocity, support.wanted);
  for (double& speed : support.wanted) speed = -speed;
  respond(equation.body(), equation.factors, support, support.wanted, response_, change_);
}

bool ImpactResponse::pulls_a_foot(const EquationOfMotion& equation, const FootContacts& contacts) const {
  const std::size_t feet = contacts.feet().soles().size();
  for (std::size_t i = 0; i < feet; ++i)
    if (response_.push[6 * i + 1] < -equation.weight_N() * kImpact_s / static_cast<double>(feet)) return true;
  return false;
}

void ImpactResponse::apply(EquationOfMotion& equation, const FootContacts& contacts, const Impact& impact) {
  find_stiff(equation, contacts, impact);
  brace(equation.state.velocity, stiff_, equation.figure->fastest, change_);
  add_scaled(1.0, change_, equation.state.velocity);
}

void ImpactResponse::find_stiff(const EquationOfMotion& equation, const FootContacts& contacts, const Impact& impact) {
  stiff_.assign(equation.size(), 0.0);
  if (!contacts.feet().none()) return;
  impulse_.assign(equation.size(), 0.0);
  add_impulse(equation.body(), equation.dynamics, impact, impulse_);
  for (double& impulse : impulse_) impulse = -impulse;
  fall_freely(equation.body(), equation.mass, stiff_, impulse_);
}

}  // namespace contort
