// An impact on a figure: the change of all velocities in no time.
#pragma once

#include "generator/dynamics/foot_contacts.h"
#include "generator/dynamics/impact.h"

namespace contort {

// In the order find, pulls_a_foot, apply. The equation must have been placed, with find_mass and find_factors.
class ImpactResponse {
 public:
  // The change with joints that do not resist and soles that stay.
  void find(EquationOfMotion& equation, FootContacts& contacts, const Impact& impact);

  // Whether a sole would have to be pulled down by more than its share of the weight presses on it meanwhile.
  bool pulls_a_foot(const EquationOfMotion& equation, const FootContacts& contacts) const;

  // Adds the change to the velocities, taken back as far as a joint would be faster than it can be (brace).
  void apply(EquationOfMotion& equation, const FootContacts& contacts, const Impact& impact);

 private:
  void find_stiff(const EquationOfMotion& equation, const FootContacts& contacts, const Impact& impact);

  std::vector<double> change_;
  std::vector<double> stiff_;  // with joints that do not move: none at all on soles
  std::vector<double> impulse_;
  ResponseScratch response_;
};

}  // namespace contort
