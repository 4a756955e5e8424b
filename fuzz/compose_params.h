// Makes values of an action's parameters, within the declared range, the joint's range, or the profile's rules.
#pragma once

#include <array>

#include "fuzz/dice.h"
#include "fuzz/profile.h"
#include "fuzz/raw.h"
#include "model/generator.h"

namespace contort {

// Fills use.params with whole degrees, centimetres or 0.1 m/s (steps_per_unit), so that specs are short and readable.
void draw_params(const Character& character, const Part& part, const OfferedAction& action, const Profile& profile,
                 const std::array<int, kRawValues>& raw, ActionUse& use);

// Moves one number in four to an end of its range, or to its default.
void take_corners(const OfferedAction& action, Dice& dice, ActionUse& use);

}  // namespace contort
