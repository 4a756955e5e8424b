// Walks on the spot, as most clips of games are: the root stays, and feet that bear slide back under it, all at the same
// speed.
#pragma once

#include <span>

#include "generator/motion/foot_rests.h"

namespace contort {

// Returns the horizontal velocity, m/s, with which the ground would have to move under such a walk; zero for any other
// motion. `paths`: sole_paths.
Vec3 belt_velocity_m_s(std::span<const Leg> legs, std::span<const SolePath> paths, const Environment& environment,
                       const Motion& motion);

}  // namespace contort
