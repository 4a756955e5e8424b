// A character as a tree of rigid bodies with a free root, for the recursions of dynamics.h.
//
// Generalised velocity, `dof_count()` doubles: the root's velocity (world, m/s), its angular velocity (its own axes,
// rad/s), then joint by joint a hinge's rate (rad/s), a travel's (m/s), or a ball's angular velocity (axes of the body
// that it moves, rad/s). These are MuJoCo's coordinates. Generalised forces are dual to them: N in the world, N m in
// the root's axes, and so on.
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/spatial.h"
#include "model/character/character.h"

namespace contort {

inline constexpr int kRootDofs = 6;

struct Link {
  JointKind kind = JointKind::root;
  int parent = -1;
  int coord = 0;  // first coordinate in a pose row
  int dof = 0;    // first entry of a generalised velocity
  int dof_count = 0;
  Vec3 axis{0.0};  // unit, in the parent's frame at rest
  // 0, 1 or 2 for a hinge that turns about x, y or z of its frame, or against it, as nearly all do; -1 for any other
  // axis.
  int turns_about = -1;
  double sense = 1.0;       // 1, or -1 if the hinge turns against that axis
  Mat3 rest{1.0};           // parent_from_link
  bool is_straight = true;  // rest has no rotation
  Vec3 origin_m{0.0};       // in the parent, at rest
  double mass_kg = 0.0;
  Vec3 center_of_mass_m{0.0};  // in the link's frame
  Mat3 inertia_kg_m2{0.0};     // about it, axes of the link's frame
  Mat3 inertia_root{0.0};      // its lower triangle L of Cholesky, L L^T = inertia_kg_m2
  bool massless = true;
};

// L, lower triangular, with L L^T = a symmetric matrix without negative eigenvalues (Cholesky).
Mat3 lower_root(const Mat3& matrix);

class Multibody {
 public:
  static Multibody of(const Character& character);

  // Adds a body to a link: mass, centre, and inertia about it in the link's frame. This is exact, because the two move
  // as one.
  void add_mass(int link, double mass_kg, const Vec3& center_of_mass_m, const Mat3& inertia_kg_m2);

  std::span<const Link> links() const { return links_; }  // in the order of the character's joints
  int dof_count() const { return static_cast<int>(parent_dof_.size()); }
  int coord_count() const { return coord_count_; }
  double mass_kg() const { return mass_kg_; }

  // The next degree of freedom towards the root that moves the same bodies; -1 at the end. It gives the sparsity of the
  // mass matrix.
  std::span<const int> parent_dof() const { return parent_dof_; }

 private:
  std::vector<Link> links_;
  std::vector<int> parent_dof_;
  int coord_count_ = 0;
  double mass_kg_ = 0.0;
};

}  // namespace contort
