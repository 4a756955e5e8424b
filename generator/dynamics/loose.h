// A figure that does not stand: it flies, tips over an edge of its feet, or lies. Only the laws of motion and the
// efforts of its joints move it. Corners and ends of its colliders touch the ground and obstacles (contact_solver.h).
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/contact_solver.h"
#include "generator/dynamics/dynamics.h"
#include "generator/dynamics/figure.h"
#include "model/world/environment.h"

namespace contort {

// A place where a link can touch: a sphere with this radius around a point.
struct TouchPoint {
  int link = 0;
  Vec3 point_m{0.0};  // in the link's frame
  double radius_m = 0.0;
  bool is_sole = false;
};

// Corners of soles, and corners and ends of all other colliders.
std::vector<TouchPoint> touch_points(const Character& character, const DynamicFigure& figure);

// Computes the root's accelerations under gravity alone, given those of the joints: overwrites the first six. `forces`
// are those of inverse dynamics with the present accelerations, and become 0 there; `mass` as in mass_matrix.
void fall_freely(const Multibody& body, std::span<const double> mass, std::span<double> acceleration,
                 std::span<double> forces);

// The whole figure's momentum about the root's origin, world axes; `mass` as in mass_matrix.
SpatialForce momentum_of(const Multibody& body, const DynamicsScratch& dynamics, std::span<const double> mass,
                         std::span<const double> velocity);

// Gives the root the velocity with which the figure has this momentum, whatever its joints do. In free motion only the
// momentum is integrated: an explicit step through a fast tumble would be unstable, but momentum cannot be. Needs the
// composites of mass_matrix.
void set_momentum(const Multibody& body, const DynamicsScratch& dynamics, std::span<const double> mass,
                  const SpatialForce& momentum, std::span<double> velocity);

// The change of momentum per second due to gravity.
SpatialForce weight_of(const DynamicsScratch& dynamics);

// Adds the touch points that may touch the ground or an obstacle within a tick. Needs a placed pose.
void add_touches(const DynamicFigure& figure, std::span<const TouchPoint> points, const Environment& environment,
                 double tick_s, std::span<const double> velocity, const DynamicsScratch& dynamics,
                 ContactSolver& solver);

}  // namespace contort
