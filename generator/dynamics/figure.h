// A figure: all constant data of a character that its dynamics need. They follow from the character's structure, so any
// assembly of parts has them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "generator/dynamics/multibody.h"
#include "model/motion/legs.h"

namespace contort {

// An additional mass that a link carries.
struct Load {
  int link = 0;
  double mass_kg = 0.0;
  Vec3 center_of_mass_m{0.0};  // in the link's frame
  Mat3 inertia_kg_m2{0.0};     // about it, axes of the link's frame
};

// A box of this size and even density, anywhere on a link.
Load box_load(int link, const Rigid& link_from_box, const Vec3& size_m, double mass_kg);

// A foot that can stand.
struct Sole {
  int link = 0;
  Rigid link_from_sole;
  Vec3 ankle_m{0.0};                // point below the ankle on the sole's plane, in the sole's frame
  double toes_N_m = 1e9;            // strength of its hinges about the sole's X against loads ahead of the ankle,
  double heel_N_m = 1e9;            // and behind it
  double tilt_N_m = 1e9;            // strength of its hinges about the sole's Z, which bear loads to the side
  std::array<Vec3, 4> corners_m{};  // of the footprint, in the link's frame, counter-clockwise seen from above
  std::vector<int> ankle_dofs;      // degrees of freedom between the leg's tip and the sole
  std::vector<int> leg_dofs;        // degrees of freedom of leg and foot, from the hip on
  std::vector<int> chain_dofs;      // all degrees of freedom that move it except for the root's, from the sole upwards
};

// A direction in which control may accelerate: one degree of freedom, or an axis of a ball.
struct Handle {
  int link = 0;
  int dof = 0;     // the degree of freedom; a ball's first one
  Vec3 axis{0.0};  // ball: in its parent's frame
  bool is_ball = false;
};

// Degrees of freedom that control uses together; as few as necessary (seed D4).
struct ControlGroup {
  std::string name;  // "arms", "back", "lower_body"
  std::vector<Handle> handles;
  double greatest = 0.0;    // acceleration, rad/s^2 or m/s^2
  bool moves_feet = false;  // legs must give way so that the feet stay
};

struct DynamicFigure {
  Multibody body;  // with the loads
  std::vector<Load> loads;
  std::vector<Sole> soles;           // in the order of find_legs
  std::vector<ControlGroup> groups;  // in the order of control
  std::vector<int> watched;          // degrees of freedom whose load is relieved: those of back and hips
  std::vector<double> strength_low;  // by degree of freedom, <= 0: N m, N; 0 for the root
  std::vector<double> strength_high;
  std::vector<double> fastest;  // by degree of freedom, rad/s or m/s; 0 for the root
};

DynamicFigure build_figure(const Character& character, std::span<const Leg> legs, std::span<const Load> loads);

}  // namespace contort
