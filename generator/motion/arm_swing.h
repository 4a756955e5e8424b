// The swing of arms that have nothing to do while their figure walks or runs on two legs.
#pragma once

#include <span>

#include "generator/motion/gait.h"
#include "model/motion/motion.h"

namespace contort {

// Whether the gait swings this part: it reaches and does not stand, is on one side, and it and what hangs on it carry no
// object.
bool is_free_arm(const Character& character, std::span<const Leg> legs, int part);

// Adds the swing to the part's coordinates, as far as its joints go. `world` must hold the part and its carrier.
void swing_arm(const Character& character, int part, const ArmSwing& swing, std::span<const Rigid> world,
               Posture& posture);

}  // namespace contort
