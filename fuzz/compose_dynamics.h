// Makes modes, loads and impacts from raw numbers.
#pragma once

#include <array>

#include "fuzz/features.h"
#include "fuzz/raw.h"
#include "model/character/character.h"
#include "model/spec/spec.h"

namespace contort {

// Loads and impacts are in proportion to the figure's mass. Loads are such as the figure should withstand: joints hold
// them with half of their strength, and they are light in the mode tracking; with Profile::wild_loads, any.
DynamicsDesc compose_dynamics(const std::array<int, kRawDynamics>& raw, const Features& features,
                              const Character& character);

}  // namespace contort
