// Modes, loads and impacts from raw numbers.
#pragma once

#include <array>

#include "generator/character/character.h"
#include "generator/spec.h"

namespace contort {

inline constexpr std::size_t kRawDynamics = 24;

// One in 32 specs tracks, one is dynamic: a simulated frame costs three kinematic ones. Loads and impacts are in proportion to the figure's mass.
DynamicsDesc compose_dynamics(const std::array<int, kRawDynamics>& raw, const Character& character);

}  // namespace contort
