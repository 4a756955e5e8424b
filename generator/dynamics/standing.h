// A figure on its soles: dynamic control, and a return towards holding still if joints or the ground cannot supply the
// forces for the target.
#pragma once

#include "generator/dynamics/control.h"
#include "generator/dynamics/foot_contacts.h"
#include "generator/dynamics/ground_rows.h"
#include "generator/dynamics/impact.h"
#include "generator/dynamics/recorder.h"
#include "generator/dynamics/steering.h"
#include "generator/dynamics/support_hull.h"

namespace contort {

class Standing {
 public:
  // The plan must outlive it.
  void begin(const DynamicFigure& figure, const BalancePlan& plan, double tick_s);

  // Sets the time of a tick in frames. `is_disturbed` is true if a force acts from outside; dynamic control is inactive
  // without one.
  void begin_tick(double frame, bool is_disturbed) { frame_ = frame, is_disturbed_ = is_disturbed; }

  // Resets control, because the velocities have changed at once.
  void rest() { control_.rest(); }

  // The figure has let go of the ground.
  void let_go();

  // Finds the support area at the placed pose.
  void find_ground(const EquationOfMotion& equation, const FootContacts& contacts, const Actuation& actuation);
  // The efforts for the actuation's forces; needs find_ground.
  void find_efforts(const EquationOfMotion& equation, Actuation& actuation);
  Balance balance(const EquationOfMotion& equation, std::span<const double> forces) const;

  // Changes the wanted accelerations so that the figure stands, with their forces and efforts; needs find_mass. Returns
  // true if the ground can hold the figure: its zero moment point neither is far outside nor stays outside.
  bool stand(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted,
             std::span<const DofEnd> ends, Recorder& record, Actuation& actuation);

  // Returns true if the figure could stand on the soles: its capture point is above them. Needs find_mass.
  bool could_stand(const EquationOfMotion& equation, const FootContacts& contacts);

  // The accelerations that control added in the last tick, by degree of freedom.
  std::span<const double> added() const { return control_.added(); }

 private:
  void hold_back(EquationOfMotion& equation, FootContacts& contacts, Recorder& record, Actuation& actuation);
  void give_way(EquationOfMotion& equation, FootContacts& contacts, Actuation& actuation);

  struct Spared {
    int dof = 0;
    double effort = 0.0;
  };
  void follow(EquationOfMotion& equation, FootContacts& contacts, std::span<const double> wanted, bool first,
              Actuation& actuation);
  void meet(const EquationOfMotion& equation, FootContacts& contacts, Actuation& actuation);
  void find_rows(const EquationOfMotion& equation, const FootContacts& contacts, const Actuation& actuation);
  double lost_m(const EquationOfMotion& equation, const FootContacts& contacts);
  bool ask_less_of_swing(FootContacts& contacts, double share, const Actuation& actuation);
  int carried_by(const EquationOfMotion& equation, const FootContacts& contacts, const Actuation& actuation,
                 int dof) const;
  bool relieve(const EquationOfMotion& equation, FootContacts& contacts, const Actuation& actuation);

  double tick_s_ = 0.0;
  double frame_ = 0.0;
  bool is_disturbed_ = false;
  Steering steering_;
  GroundControl ground_control_;
  std::vector<GroundRow> rows_;  // rows of this tick
  Vec3 zmp_m_{0.0};              // zero moment point of the rows
  bool has_zmp_ = false;
  int asked_ = 0;  // number of attempts in this tick that demanded less of feet in the air
  std::vector<Spared> spared_;
  Actuation base_;               // scratch
  std::vector<Vec3> corners_m_;  // scratch
  HullScratch hull_;
  std::vector<double> zeros_;
  std::vector<double> ease_;  // ease in this tick
  double outside_s_ = 0.0;    // time for which the zero moment point has been outside
  SupportArea area_;
  GroundShare ground_;
  DynamicControl control_;
  Actuation hold_;  // actuation for holding still
  ResponseScratch response_;
};

}  // namespace contort
