// A figure without hold on the ground: it flies, tips or lies until soles carry its weight again (loose.h).
#pragma once

#include "generator/dynamics/body_contacts.h"
#include "generator/dynamics/equation_of_motion.h"
#include "generator/dynamics/loose.h"
#include "model/motion/motion.h"

namespace contort {

// Knows if the figure is loose or has fallen, and its momentum from tick to tick. A fallen figure never stands again:
// its joints go limp.
class LooseMotion {
 public:
  void begin(double tick_s);

  bool is_loose() const { return is_loose_; }
  bool has_fallen() const { return has_fallen_; }

  void let_go();
  void take_hold() { is_loose_ = false; }

  // False until move was called since the figure let go.
  bool knows_contacts() const { return has_momentum_; }

  // Call this when velocities were changed from outside, such as by a blow.
  void forget_momentum() { has_momentum_ = false; }

  // Gives the state the momentum of the previous tick, if there is one; needs find_mass.
  void carry_momentum(EquationOfMotion& equation);

  // Joints move as wanted, as far as each is strong enough; the root follows. Needs find_mass.
  void fall(EquationOfMotion& equation, std::span<const double> wanted, Actuation& actuation);

  // Changes the velocities, and with them the momentum, only by weight, contacts, contacts between bodies of the
  // figure, and the ends of joints. `before` is the momentum before joints changed their velocities.
  void move(const Character& character, EquationOfMotion& equation, std::span<const TouchPoint> touches,
            std::span<const BodyContact> bodies, const Environment& environment, const SpatialForce& before);

  // After move, if velocities were changed again: gives the figure back the speed of its centre of mass, by the root.
  void keep_way(EquationOfMotion& equation) const;

  // After move: the footing, from the figure's contacts and its tilt against the target's root rotation.
  Footing footing(const Quat& root, const Quat& wanted_root);

 private:
  void add_stops(const Character& character, const EquationOfMotion& equation);
  void fly(const EquationOfMotion& equation, Actuation& actuation) const;

  double tick_s_ = 0.0;
  bool is_loose_ = false;
  bool has_fallen_ = false;
  bool has_momentum_ = false;
  SpatialForce momentum_;  // about the world's origin, which keeps it while the root moves
  ContactSolver contacts_;
};

}  // namespace contort
