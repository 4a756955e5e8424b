// A figure that has let go of the ground: it flies, tips or lies until soles take its weight again (loose.h).
#pragma once

#include "generator/dynamics/body_contacts.h"
#include "generator/dynamics/equation_of_motion.h"
#include "generator/dynamics/loose.h"
#include "model/motion/motion.h"

namespace contort {

// Whether the figure is loose, whether it has fallen, and its momentum from tick to tick. One that has fallen never
// stands again: its joints go limp.
class LooseMotion {
 public:
  void begin(double tick_s);

  bool is_loose() const { return is_loose_; }
  bool has_fallen() const { return has_fallen_; }

  void let_go();
  void take_hold() { is_loose_ = false; }

  // The velocities have been changed by something else, such as a blow.
  void forget_momentum() { has_momentum_ = false; }

  // Gives the state the momentum of the tick before, if there is one; needs find_mass.
  void carry_momentum(EquationOfMotion& equation);

  // Joints go on as they are told, each as far as it is strong enough; the rest follows. Needs find_mass.
  void fall(EquationOfMotion& equation, std::span<const double> wanted, Actuation& actuation);

  // Weight, contacts, those of bodies of the figure with each other, and the ends of joints change the velocities, and
  // with them the momentum, and nothing else does.
  // `before` is the momentum before joints changed their velocities.
  void move(const Character& character, EquationOfMotion& equation, std::span<const TouchPoint> touches,
            std::span<const BodyContact> bodies, const Environment& environment, const SpatialForce& before);

  // After move: what the figure touches, and how it stands against the target's root rotation.
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
