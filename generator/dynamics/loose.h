// A figure that does not stand: it flies, tips over an edge of its feet, or lies. Its root moves by the laws of motion
// alone; joints go on as commanded, stiff against the ground. The ground is felt at corners and ends of colliders,
// which may neither sink in nor be pulled, with Coulomb friction: impulses by projected Gauss-Seidel (J. J. Moreau's
// time-stepping; D. E. Stewart, "Rigid-body dynamics with friction and impact", SIAM Review 42, 2000).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "generator/dynamics/dynamics.h"
#include "generator/dynamics/figure.h"
#include "model/world/environment.h"

namespace contort {

// A place where a link can touch: a sphere of this radius around a point.
struct TouchPoint {
  int link = 0;
  Vec3 point_m{0.0};  // in the link's frame
  double radius_m = 0.0;
  bool is_sole = false;
};

// Corners of soles, and corners and ends of all other colliders.
std::vector<TouchPoint> touch_points(const Character& character, const DynamicFigure& figure);

struct LooseScratch {
  struct Contact {
    SpatialForce push[3];     // unit ones along the normal and two tangents, about the root's origin
    SpatialMotion answer[3];  // of the figure to them
    int link = 0;
    double least_speed = 0.0;  // along the normal, m/s
    double impulse[3] = {0.0, 0.0, 0.0};
    bool is_sole = false;
  };
  std::vector<Contact> contacts;
  std::vector<SpatialMotion> velocity;  // by link
};

// Root accelerations under no force but gravity, given those of the joints: overwrites the first six. `forces` are
// those of inverse dynamics with the accelerations as they are, and are brought to 0 there; `mass` as in mass_matrix.
void fall_freely(const Multibody& body, std::span<const double> mass, std::span<double> acceleration,
                 std::span<double> forces);

// The whole figure's momentum about the root's origin, world axes; `mass` as in mass_matrix.
SpatialForce momentum_of(const Multibody& body, const DynamicsScratch& dynamics, std::span<const double> mass,
                         std::span<const double> velocity);

// Gives the root the velocity with which the figure has this momentum, whatever its joints do. In free motion nothing
// else is integrated: an explicit step through a fast tumble would blow up, and momentum cannot. Needs the composites
// of mass_matrix.
void set_momentum(const Multibody& body, const DynamicsScratch& dynamics, std::span<const double> mass,
                  const SpatialForce& momentum, std::span<double> velocity);

// The momentum that gravity adds in a second.
SpatialForce weight_of(const DynamicsScratch& dynamics);

// Changes the root's velocity so that no point gets deeper into the ground within a tick. Needs a placed pose and the
// composites of mass_matrix.
void push_off(const DynamicFigure& figure, std::span<const TouchPoint> points, const Environment& environment,
              double tick_s, const DynamicsScratch& dynamics, LooseScratch& scratch, std::span<double> velocity);

}  // namespace contort
