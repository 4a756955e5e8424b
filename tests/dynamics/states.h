// Random states of characters, for tests of dynamics.
#pragma once

#include <random>
#include <vector>

#include "generator/dynamics/dynamics.h"

namespace contort::fixtures {

struct DynamicsState {
  Rigid root;
  std::vector<double> coords;
  std::vector<double> velocity;
  std::vector<double> acceleration;
};

inline double between(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

inline Vec3 any_vec(std::mt19937_64& random, double size) {
  const double x = between(random, -size, size), y = between(random, -size, size);
  return {x, y, between(random, -size, size)};
}

// Angles within 1.2 rad: three hinges in one point are singular where the middle one is at a right angle.
inline DynamicsState any_state(const Multibody& body, std::mt19937_64& random) {
  DynamicsState state;
  state.root = {from_rotation_vector(any_vec(random, 1.5)), any_vec(random, 2.0)};
  state.coords.assign(static_cast<std::size_t>(body.coord_count()), 0.0);
  for (const Link& link : body.links().subspan(1)) {
    double* q = &state.coords[static_cast<std::size_t>(link.coord)];
    if (link.kind == JointKind::ball) {
      const Quat turn = from_rotation_vector(any_vec(random, 1.5));
      q[0] = turn.w, q[1] = turn.x, q[2] = turn.y, q[3] = turn.z;
    } else {
      q[0] = between(random, -1.2, 1.2) * (link.kind == JointKind::prismatic ? 0.1 : 1.0);
    }
  }
  for (int i = 0; i < body.dof_count(); ++i) {
    state.velocity.push_back(between(random, -2.0, 2.0));
    state.acceleration.push_back(between(random, -5.0, 5.0));
  }
  return state;
}

}  // namespace contort::fixtures
