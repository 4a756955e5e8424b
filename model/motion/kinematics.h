// Forward kinematics: computes world transforms from coordinates.
#pragma once

#include <span>

#include "model/character/character.h"

namespace contort {

// The joint's own motion at the given coordinates: a rotation about its axis, or a translation along it.
Rigid joint_motion(const Joint& joint, std::span<const double> row);

// world_from_joint of joints [first, last). Parents of the range must be in `world` already.
void forward_kinematics(const Character& character, std::span<const double> row, int first, int last,
                        std::span<Rigid> world);

// Does the same for the listed joints, parents first.
void forward_kinematics(const Character& character, std::span<const double> row, std::span<const int> joints,
                        std::span<Rigid> world);

// Computes the transforms of all joints; world[0] = root.
void forward_kinematics(const Character& character, const Rigid& root, std::span<const double> row,
                        std::span<Rigid> world);

Rigid world_from_socket(const Character& character, std::span<const Rigid> world, int socket);

}  // namespace contort
