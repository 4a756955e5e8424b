#include "generator/dynamics/loose_motion.h"

#include <algorithm>

#include "generator/dynamics/strength.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kLying_cos = 0.5;    // a trunk 60 degrees from its target's up has fallen
constexpr double kLimp_per_s = 10.0;  // damping of joints after a fall

}  // namespace

void LooseMotion::begin(const DynamicFigure& figure, double tick_s) {
  tick_s_ = tick_s;
  is_loose_ = has_fallen_ = has_momentum_ = false;
  hold_.assign(at(figure.body.dof_count()));
}

void LooseMotion::let_go() {
  is_loose_ = true;
  has_momentum_ = false;
}

void LooseMotion::carry_momentum(EquationOfMotion& equation) {
  if (!has_momentum_) return;
  const Vec3 moment = momentum_.moment - glm::cross(equation.state.root.p_m, momentum_.force);
  set_momentum(equation.body(), equation.dynamics, equation.mass, {moment, momentum_.force}, equation.state.velocity);
}

void LooseMotion::fall(EquationOfMotion& equation, std::span<const double> wanted, Actuation& actuation) {
  equation.find_bias();
  std::ranges::copy(wanted, actuation.acceleration.begin());
  std::fill_n(actuation.acceleration.begin(), kRootDofs, 0.0);
  if (has_fallen_)
    for (std::size_t k = kRootDofs; k < equation.size(); ++k)
      actuation.acceleration[k] = -std::min(kLimp_per_s, 0.5 / tick_s_) * equation.state.velocity[k];
  fly(equation, actuation);
  if (!exceeds_strength(*equation.figure, actuation.efforts)) return;
  std::ranges::fill(hold_.acceleration, 0.0);
  fly(equation, hold_);
  const double share = affordable_share(*equation.figure, hold_.efforts, actuation.efforts);
  take_back(hold_, share, actuation);
  for (std::size_t k = kRootDofs; k < equation.size(); ++k)
    actuation.efforts[k] = hold_.efforts[k] + share * (actuation.efforts[k] - hold_.efforts[k]);
}

// Root accelerations of free fall, and the efforts of the joints.
void LooseMotion::fly(const EquationOfMotion& equation, Actuation& actuation) const {
  equation.find_forces(actuation.acceleration, actuation.efforts);
  fall_freely(equation.body(), equation.mass, actuation.acceleration, actuation.efforts);
  std::fill_n(actuation.efforts.begin(), kRootDofs, 0.0);
}

void LooseMotion::move(EquationOfMotion& equation, std::span<const TouchPoint> touches,
                       const Environment& environment, const SpatialForce& before) {
  const SpatialForce weight = weight_of(equation.dynamics);
  SpatialForce momentum = before;
  momentum += {tick_s_ * weight.moment, tick_s_ * weight.force};
  std::vector<double>& velocity = equation.state.velocity;
  set_momentum(equation.body(), equation.dynamics, equation.mass, momentum, velocity);
  push_off(*equation.figure, touches, environment, tick_s_, equation.dynamics, scratch_, velocity);
  momentum_ = momentum_of(equation.body(), equation.dynamics, equation.mass, velocity);
  momentum_.moment += glm::cross(equation.state.root.p_m, momentum_.force);
  has_momentum_ = true;
}

Footing LooseMotion::footing(const Quat& root, const Quat& wanted_root) {
  bool on_sole = false, on_other = false;
  for (const LooseScratch::Contact& contact : scratch_.contacts)
    if (contact.impulse[0] > 0.0) (contact.is_sole ? on_sole : on_other) = true;
  const Vec3 up = root * Vec3(0, 1, 0), wanted = wanted_root * Vec3(0, 1, 0);
  has_fallen_ = has_fallen_ || on_other || glm::dot(up, wanted) < kLying_cos;
  return has_fallen_ ? Footing::fallen : on_sole ? Footing::tipping : Footing::airborne;
}

}  // namespace contort
