#include "generator/dynamics/loose_motion.h"

#include <algorithm>

#include "generator/dynamics/joint_ends.h"
#include "generator/dynamics/racing.h"
#include "generator/dynamics/strength.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kLying_cos = 0.5;    // a trunk 60 degrees from its target's up has fallen
constexpr double kNearEnd = 0.01;     // rad or m: joints nearer to an end than this may stop there
constexpr double kLimp_per_s = 10.0;  // damping of joints after a fall

}  // namespace

void LooseMotion::begin(double tick_s) {
  tick_s_ = tick_s;
  is_loose_ = has_fallen_ = has_momentum_ = false;
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
  clamp_to_strength(*equation.figure, actuation.efforts);
  equation.find_factors();
  for (std::size_t k = 0; k < equation.size(); ++k) actuation.acceleration[k] = actuation.efforts[k] - equation.bias[k];
  solve(equation.body(), equation.factors, actuation.acceleration);
}

// Root accelerations of free fall, and the efforts of the joints.
void LooseMotion::fly(const EquationOfMotion& equation, Actuation& actuation) const {
  equation.find_forces(actuation.acceleration, actuation.efforts);
  fall_freely(equation.body(), equation.mass, actuation.acceleration, actuation.efforts);
  std::fill_n(actuation.efforts.begin(), kRootDofs, 0.0);
}

void LooseMotion::move(const Character& character, EquationOfMotion& equation, std::span<const TouchPoint> touches,
                       std::span<const BodyContact> bodies, const Environment& environment,
                       const SpatialForce& before) {
  const SpatialForce weight = weight_of(equation.dynamics);
  SpatialForce momentum = before;
  momentum += {tick_s_ * weight.moment, tick_s_ * weight.force};
  std::vector<double>& velocity = equation.state.velocity;
  set_momentum(equation.body(), equation.dynamics, equation.mass, momentum, velocity);
  contacts_.begin(equation, false);
  add_touches(*equation.figure, touches, environment, tick_s_, velocity, equation.dynamics, contacts_);
  for (const BodyContact& contact : bodies) contacts_.add_pair(contact, -std::max(contact.gap_m, 0.0) / tick_s_);
  add_stops(character, equation);
  contacts_.solve(velocity);
  momentum_ = momentum_of(equation.body(), equation.dynamics, equation.mass, velocity);
  momentum_.moment += glm::cross(equation.state.root.p_m, momentum_.force);
  has_momentum_ = true;
}

void LooseMotion::keep_way(EquationOfMotion& equation) const {
  std::vector<double>& velocity = equation.state.velocity;
  const SpatialForce now = momentum_of(equation.body(), equation.dynamics, equation.mass, velocity);
  const Vec3 missing = (1.0 / equation.body().mass_kg()) * (momentum_.force - now.force);
  for (int k = 0; k < 3; ++k) velocity[at(k)] += missing[k];
}

// Joints that could come to their ends in this tick, whichever way a contact turns them.
void LooseMotion::add_stops(const Character& character, const EquationOfMotion& equation) {
  for (std::size_t i = 1; i < equation.body().links().size(); ++i) {
    const Link& link = equation.body().links()[i];
    const Joint& joint = character.joints()[i];
    const double* now = &equation.state.coords[at(link.coord)];
    const double within = kNearEnd + tick_s_ * kRacing * equation.figure->fastest[at(link.dof)];
    const auto speed = [&](double room) { return -std::max(room, 0.0) / tick_s_; };
    if (link.kind == JointKind::ball) {
      const BallEnds ends = near_ends(joint, now, within);
      for (const BallEnd& end : ends.all()) contacts_.add_ball_stop(link.dof, -end.out, speed(end.room_rad));
      continue;
    }
    const double below = joint.high - *now, above = *now - joint.low;
    if (below < within) contacts_.add_stop(link.dof, -1.0, speed(below));
    if (above < within) contacts_.add_stop(link.dof, 1.0, speed(above));
  }
}

Footing LooseMotion::footing(const Quat& root, const Quat& wanted_root) {
  const bool on_sole = contacts_.pushes(true), on_other = contacts_.pushes(false);
  const Vec3 up = root * Vec3(0, 1, 0), wanted = wanted_root * Vec3(0, 1, 0);
  has_fallen_ = has_fallen_ || on_other || glm::dot(up, wanted) < kLying_cos;
  return has_fallen_ ? Footing::fallen : on_sole ? Footing::tipping : Footing::airborne;
}

}  // namespace contort
