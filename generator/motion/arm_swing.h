// The swing of idle arms while their figure walks or runs on two legs.
#pragma once

#include <span>

#include "generator/motion/gait.h"
#include "model/motion/motion.h"

namespace contort {

// Returns true if the gait swings this part: it can reach but does not stand on the ground, it is on one side, and
// neither it nor a part that it carries holds an object.
bool is_free_arm(const Character& character, std::span<const Leg> legs, int part);

// Adds the swing to the part's coordinates, as far as its joints go. `world` must hold the part and its carrier.
void swing_arm(const Character& character, int part, const ArmSwing& swing, std::span<const Rigid> world,
               Posture& posture);

}  // namespace contort
