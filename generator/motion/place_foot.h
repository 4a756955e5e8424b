// Puts feet at the places of a course.
#pragma once

#include <span>

#include "model/motion/legs.h"

namespace contort {

// Turns the leg and its ankles so that the sole is where it should be, as nearly as its bones and hinges allow. `world`
// must hold the carrier of the leg; its entries for leg and foot are scratch. Writes the coordinates of both parts.
void place_foot(const Character& character, const Leg& leg, std::span<Rigid> world, const Rigid& world_from_sole,
                std::span<double> row);

// Turns only the ankles, so that the sole's +Y points in a direction. `world` must hold the leg.
void level_foot(const Character& character, const Leg& leg, std::span<Rigid> world, const Vec3& up_world,
                std::span<double> row);

}  // namespace contort
