// A figure: all of a character that its dynamics need and that does not change while it moves. Everything here follows
// from the character's structure, so that any assembly of parts has it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "generator/dynamics/multibody.h"
#include "model/motion/legs.h"

namespace contort {

// A mass that a link carries beyond its own.
struct Load {
  int link = 0;
  double mass_kg = 0.0;
  Vec3 center_of_mass_m{0.0};  // in the link's frame
  Mat3 inertia_kg_m2{0.0};     // about it, axes of the link's frame
};

// An even box of this size, anywhere on a link.
Load box_load(int link, const Rigid& link_from_box, const Vec3& size_m, double mass_kg);

// A foot that can stand.
struct Sole {
  int link = 0;
  Rigid link_from_sole;
  Vec3 ankle_m{0.0};                // above this point of the sole's plane, in the sole's frame
  double flex_N_m = 1e9;            // strength of its hinges about the sole's X, which bear what is ahead or behind,
  double tilt_N_m = 1e9;            // and about its Z, which bear what is beside
  std::array<Vec3, 4> corners_m{};  // of the footprint, in the link's frame, counter-clockwise seen from above
  std::vector<int> ankle_dofs;      // between the leg's tip and the sole
  std::vector<int> leg_dofs;        // degrees of freedom of leg and foot, from the hip on
  std::vector<int> chain_dofs;      // all that move it but the root's, from the sole upwards
};

// A direction in which control may accelerate: one freedom, or an axis of a ball.
struct Handle {
  int link = 0;
  int dof = 0;     // the freedom; a ball's first one
  Vec3 axis{0.0};  // ball: in its parent's frame
  bool is_ball = false;
};

// Freedoms that control uses together, the smallest number that matters (seed D4).
struct ControlGroup {
  std::string name;  // "arms", "back", "lower_body"
  std::vector<Handle> handles;
  double greatest = 0.0;    // acceleration, rad/s^2 or m/s^2
  bool moves_feet = false;  // legs must give way so that the feet stay
};

struct DynamicFigure {
  Multibody body;  // with its loads
  std::vector<Load> loads;
  std::vector<Sole> soles;           // as find_legs
  std::vector<ControlGroup> groups;  // in the order of control
  std::vector<int> watched;          // freedoms whose load is relieved: the back's and the hips'
  std::vector<double> strength_low;  // by freedom, <= 0: N m, N; of the root: 0
  std::vector<double> strength_high;
  std::vector<double> fastest;  // by freedom, rad/s or m/s; of the root: 0
};

DynamicFigure build_figure(const Character& character, std::span<const Leg> legs, std::span<const Load> loads);

}  // namespace contort
