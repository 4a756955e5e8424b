// A figure on its soles: dynamic control, and a return towards holding still where joints or the ground cannot give
// what the target would take.
#pragma once

#include "generator/dynamics/control.h"
#include "generator/dynamics/foot_contacts.h"
#include "generator/dynamics/impact.h"
#include "generator/dynamics/recorder.h"

namespace contort {

class Standing {
 public:
  void begin(const DynamicFigure& figure, double tick_s);

  // Feet have come or gone: control forgets what it was doing.
  void rest() { control_.rest(); }

  // The figure has let go of the ground.
  void let_go();

  // The support area at the placed pose, and the efforts that belong to the actuation's forces.
  void find_ground(const EquationOfMotion& equation, const FootContacts& contacts, Actuation& actuation);
  Balance balance(const EquationOfMotion& equation, std::span<const double> forces) const;

  // From the wanted accelerations to those with which the figure stands, their forces and efforts; needs find_mass.
  // Answers whether the ground can hold the figure: its zero moment point neither is far outside nor stays outside.
  bool stand(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted, Recorder& record,
             Actuation& actuation);

  // Whether the weight would be above the standing soles with the wanted accelerations; needs find_mass.
  bool could_stand(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted,
                   Actuation& actuation);

  // The accelerations that control added in the last tick, by freedom.
  std::span<const double> added() const { return control_.added(); }

 private:
  void keep(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted, Actuation& actuation);
  bool needs_too_much(const EquationOfMotion& equation, const Actuation& actuation, bool has_soles) const;
  void hold_back(EquationOfMotion& equation, FootContacts& contacts, Recorder& record, Actuation& actuation);
  void give_way(EquationOfMotion& equation, FootContacts& contacts, Actuation& actuation);

  double tick_s_ = 0.0;
  double outside_s_ = 0.0;  // how long the zero moment point has been outside
  SupportArea area_;
  GroundShare ground_;
  DynamicControl control_;
  Actuation hold_;  // of holding still
  ResponseScratch response_;
};

}  // namespace contort
