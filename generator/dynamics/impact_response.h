// An impact on a figure: the instantaneous change of all velocities.
#pragma once

#include "generator/dynamics/contact_solver.h"
#include "generator/dynamics/foot_contacts.h"
#include "generator/dynamics/impact.h"

namespace contort {

class ImpactResponse {
 public:
  // Adds the change of velocities due to an impact. Joints do not resist, but brace as far as one of them would exceed
  // its greatest speed. Soles on the ground have contact forces and friction (contact_solver.h), and may be relieved of
  // the weight that presses on them meanwhile. The equation must have been placed, with find_mass and find_factors.
  void strike(EquationOfMotion& equation, const FootContacts& contacts, const Environment& environment,
              const Impact& impact);

  // After strike: the greatest speed of a bearing point of a sole, m/s.
  double sole_speed_m_s() const { return sole_speed_m_s_; }

 private:
  void add_soles(const EquationOfMotion& equation, const FootContacts& contacts, const Environment& environment);
  void answer(const EquationOfMotion& equation, const FootContacts& contacts, const Environment& environment,
              bool is_stiff, std::vector<double>& change);
  void find_sole_speed(const EquationOfMotion& equation, const FootContacts& contacts);

  std::vector<double> change_;
  std::vector<double> stiff_;  // with fixed joints
  std::vector<double> impulse_;
  std::vector<double> velocity_;
  std::vector<Vec3> points_m_;
  ContactSolver solver_;
  double sole_speed_m_s_ = 0.0;
};

}  // namespace contort
