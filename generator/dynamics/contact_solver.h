// Impulses at contacts and at the ends of joints, which change the velocities of a figure. Contacts push and never
// pull, with Coulomb friction; joints stop at their ends. Projected Gauss-Seidel in a fixed order (J. J. Moreau's
// time-stepping; D. E. Stewart, "Rigid-body dynamics with friction and impact", SIAM Review 42, 2000).
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/body_contacts.h"
#include "generator/dynamics/equation_of_motion.h"

namespace contort {

inline constexpr double kFriction = 0.8;  // coefficient of a rubber sole on dry ground

// A point of a link that touches another surface.
struct TouchedPoint {
  int link = 0;
  Vec3 from_root_m{0.0};     // world axes
  Vec3 normal{0.0};          // out of the touched surface
  double least_m_s = 0.0;    // least speed along the normal; < 0 if there is still a gap
  double preload_N_s = 0.0;  // impulse that presses on it anyway: it may be relieved of it, and have friction with it
  bool is_sole = false;
};

class ContactSolver {
 public:
  // Begins a problem at the placed pose; needs find_mass and find_factors. The joints of a stiff figure do not move.
  void begin(const EquationOfMotion& equation, bool is_stiff);

  void add_touch(const TouchedPoint& touch);
  // Adds two bodies of the figure that separate with at least this speed, m/s, without friction.
  void add_pair(const BodyContact& pair, double least_m_s);
  // Adds a joint's degree of freedom that must have at least this speed in the direction 1 or -1.
  void add_stop(int dof, double sense, double least_speed);
  // The same for a ball: along a unit vector in the axes of the moved body.
  void add_ball_stop(int dof, const Vec3& sense, double least_speed);

  // Changes the velocities, one for each degree of freedom.
  void solve(std::span<double> velocity);

  // After solve: true if any contact of soles, or of other points, pushes.
  bool pushes(bool soles) const;

 private:
  struct Row {
    double impulse = 0.0;
    double least_speed = 0.0;
    double preload = 0.0;
    double softness = 0.0;  // change of speed by a unit impulse
    int normal = -1;        // for friction: the row of its contact
    int stop_dof = -1;      // for a joint's end: its first degree of freedom
    int stop_dofs = 1;
    Vec3 stop_sense{0.0};
    bool is_sole = false;
    bool is_own = false;    // a contact of two bodies of the figure
    // The degrees of freedom, after the root's, that move a contact.
    std::size_t first_dof = kRootDofs, end_dof = kRootDofs;
  };
  void add_row(const Row& row);
  void add_stop_row(const Row& row);
  double stopped_speed(const Row& row, std::span<const double> velocity) const;
  void solve_answer(std::span<double> right) const;
  void find_link(int link);
  std::span<double> jacobian(std::size_t row) { return std::span(jacobians_).subspan(row * size_, size_); }
  std::span<double> answer(std::size_t row) { return std::span(answers_).subspan(row * size_, size_); }
  double speed_of(std::size_t row, std::span<const double> velocity);
  double push(std::size_t row, std::span<double> velocity);

  const EquationOfMotion* equation_ = nullptr;
  bool is_stiff_ = false;
  std::size_t size_ = 0;
  std::vector<double> root_factors_;
  int link_ = -1;                     // link of the last touch
  std::size_t link_first_dof_ = kRootDofs, link_end_dof_ = kRootDofs;
  std::vector<Six> link_rows_;     // for each degree of freedom: its contribution to the link's moments and forces
  std::vector<Six> link_answers_;  // for each degree of freedom: its velocity after a unit moment or force on the link
  std::vector<Row> rows_;
  std::vector<double> jacobians_;  // rows x degrees of freedom
  std::vector<double> answers_;    // rows x degrees of freedom: velocities after a unit impulse
};

}  // namespace contort
