// Makes modes, loads and impacts from raw numbers.
#pragma once

#include <array>

#include "fuzz/features.h"
#include "fuzz/raw.h"
#include "model/character/character.h"
#include "model/spec/spec.h"

namespace contort {

// Loads and impacts are in proportion to the figure's mass.
DynamicsDesc compose_dynamics(const std::array<int, kRawDynamics>& raw, const Features& features,
                              const Character& character);

}  // namespace contort
