// A figure on its soles: dynamic control, and a return towards holding still where joints or the ground cannot give
// what the target would take.
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

  // The time of a tick in frames, and whether anything acts on the figure from outside: dynamic control waits for that.
  void begin_tick(double frame, bool is_disturbed) { frame_ = frame, is_disturbed_ = is_disturbed; }

  // Control forgets what it was doing, because the velocities have changed at once.
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

  // Whether the figure would stay above the standing soles: its capture point is there. Needs find_mass.
  bool could_stand(const EquationOfMotion& equation, const FootContacts& contacts);

  // The accelerations that control added in the last tick, by freedom.
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
  bool relieve(const EquationOfMotion& equation, FootContacts& contacts, const Actuation& actuation);

  double tick_s_ = 0.0;
  double frame_ = 0.0;
  bool is_disturbed_ = false;
  Steering steering_;
  GroundControl ground_control_;
  std::vector<GroundRow> rows_;  // of this tick
  Vec3 zmp_m_{0.0};              // that they ask for
  bool has_zmp_ = false;
  int asked_ = 0;  // attempts of this tick that asked less of feet in the air
  std::vector<Spared> spared_;
  Actuation base_;               // memory
  std::vector<Vec3> corners_m_;  // memory
  HullScratch hull_;
  std::vector<double> zeros_;
  std::vector<double> ease_;  // of this tick
  double outside_s_ = 0.0;    // how long the zero moment point has been outside
  SupportArea area_;
  GroundShare ground_;
  DynamicControl control_;
  Actuation hold_;  // of holding still
  ResponseScratch response_;
};

}  // namespace contort
