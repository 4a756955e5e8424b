// Contacts of a figure's bodies with each other. While a force acts from outside, a swinging arm stops at the trunk or
// at a thigh, as a joint stops at its end (joint_ends.h). Only the pairs of bodies that self_collision judges can
// touch. Bodies that overlap do not go farther into each other, but are not pushed apart, because their target may
// require the overlap.
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/equation_of_motion.h"
#include "model/geometry/distance.h"

namespace contort {

// Two bodies near each other.
struct BodyContact {
  int link_a = 0;
  int link_b = 0;
  Vec3 from_root_m{0.0};  // point of contact; world axes
  Vec3 normal{0.0};       // unit, from a to b
  double gap_m = 0.0;     // < 0: they overlap
};

class BodyContacts {
 public:
  // The character and the body must outlive this object.
  void begin(const Character& character, const DynamicFigure& figure);

  // Finds the contacts that are nearer than `within_m`, at the placed pose. In a standing figure, contacts that slow()
  // and stop() cannot keep open, such as those of two feet, are left out.
  void find(const DynamicsScratch& dynamics, double within_m, bool stands);
  void clear() { contacts_.clear(); }
  std::span<const BodyContact> contacts() const { return contacts_; }

  // Bounds accelerations so that no contact closes within `ahead_s`, and velocities so that none closes in this tick.
  // Degrees of freedom of legs and trunk are not changed; of the others, those that move least mass change most. The
  // equation's mass matrix may be from an earlier tick.
  void slow(const EquationOfMotion& equation, double ahead_s, std::span<double> acceleration);
  void stop(const EquationOfMotion& equation, double tick_s, std::span<double> velocity);

 private:
  struct Pair {
    std::size_t a = 0;  // indices of solids
    std::size_t b = 0;
    bool gives_way = false;  // some degree of freedom between the two may change
  };
  // The effect of a degree of freedom: the rate at which its unit rate opens a contact, and the mass that it moves.
  struct Share {
    std::size_t dof = 0;
    double opens = 0.0;
    double mass = 0.0;  // infinite if the degree of freedom must not change
  };
  void find_shares(const EquationOfMotion& equation, const BodyContact& contact);
  double opening(const BodyContact& contact) const;
  void open(double missing, std::span<double> rates) const;
  template <class Missing>
  void open_where(const EquationOfMotion& equation, std::span<double> rates, Missing missing);

  std::vector<int> links_;     // link of each solid
  std::vector<Solid> solids_;  // solids in the frames of their links
  std::vector<Solid> placed_;  // relative to the root's origin, world axes
  std::vector<Pair> pairs_;
  std::vector<char> left_alone_;  // by degree of freedom
  std::vector<BodyContact> contacts_;
  std::vector<double> openings_;        // by contact: rates at which they open, for slow()
  std::vector<SpatialMotion> motions_;  // by link: motions due to the rates
  std::vector<Share> shares_;           // for one contact
};

// Calls visit(dof, moves_a) for each degree of freedom that moves one of two links and not the other; `moves_a` is true
// if it moves a.
template <class Visit>
void for_freedoms_between(const Multibody& body, int link_a, int link_b, Visit visit) {
  const auto last_dof = [&](int link) {
    const Link& own = body.links()[static_cast<std::size_t>(link)];
    return own.dof + own.dof_count - 1;
  };
  int a = last_dof(link_a), b = last_dof(link_b);
  while (a != b) {
    int& farther = a > b ? a : b;
    visit(static_cast<std::size_t>(farther), a > b);
    farther = body.parent_dof()[static_cast<std::size_t>(farther)];
  }
}

// Calls visit(dof, opens) for these degrees of freedom of a contact: a unit rate of one opens the contact by `opens`
// per second.
template <class Visit>
void for_openings(const Multibody& body, const DynamicsScratch& dynamics, const BodyContact& contact, Visit visit) {
  for_freedoms_between(body, contact.link_a, contact.link_b, [&](std::size_t dof, bool moves_a) {
    const double along = glm::dot(point_velocity(dynamics.freedoms[dof], contact.from_root_m), contact.normal);
    visit(dof, moves_a ? -along : along);
  });
}

}  // namespace contort
