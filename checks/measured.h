// The measured value behind a margin. A check reports the distance from a limit, but people want to read the value and
// the limit.
#pragma once

#include <optional>
#include <string_view>

#include "checks/settings.h"
#include "model/character/character.h"

namespace contort {

struct Measured {
  double value = 0.0;  // in the unit of the check's margins; torques are fractions of the joint's strength
  double limit = 0.0;  // in the same unit, with the tolerance of the settings
  bool operator==(const Measured&) const = default;
};

// Returns the value and its limit for a margin of a subject, where the character and the margin determine both. It
// returns nothing for checks whose limit depends on the motion (pop, the swing of a ball joint), for unknown subjects,
// for a margin of NaN, and if a rule of the settings holds in one phase only.
std::optional<Measured> measured_of(const Character& character, const CheckSettings& settings, std::string_view check,
                                    std::string_view subject, double margin);

}  // namespace contort
