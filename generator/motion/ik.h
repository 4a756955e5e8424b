// Inverse kinematics. Nothing here clamps to joint ranges, because a clamp would hide exactly the fault that the checks
// look for.
#pragma once

#include <array>
#include <span>

#include "model/character/character.h"

namespace contort {

// Turns the chain so that its tip is at the target, as near as its bones allow; writes the coordinates of `upper` and
// `middle` and leaves the rest as it is. The middle joint bends by the law of cosines; the upper joint takes the
// smallest rotation from rest that points the tip at the target, then turns by swivel_rad about the line to the target.
// `world` must hold the parent of the upper joint.
void reach_for(const Character& character, const ReachChain& chain, std::span<const Rigid> world,
               const Vec3& target_world_m, double swivel_rad, std::span<double> row);

// Turns the chain so that its socket's +Z faces the (unit) direction: cyclic coordinate descent over directions, from
// the rest pose of the chain, outermost joint first. Writes the coordinates of the chain's joints; `world` must hold
// the parent of the first, and its entries for the part's joints are used as scratch.
void face_direction(const Character& character, const FacingChain& chain, std::span<Rigid> world,
                    const Vec3& direction_world, std::span<double> row);

// Turns any joints so that any axis of a socket faces the direction.
void turn_axis_to(const Character& character, std::span<const int> joints, int socket, const Vec3& socket_axis,
                  std::span<Rigid> world, const Vec3& direction_world, std::span<double> row);

// The two angles in [-pi, pi) with x cos(angle) + y sin(angle) = wanted, or, if there are none, nearest to it: the
// rotation of a hinge for which a point or direction has a wanted component. 0, 0 if no rotation has an effect.
std::array<double, 2> solve_turn(double x, double y, double wanted);

// Two successive hinges, the second at rotation `between` in the first one's frame when that one is at rest.
struct HingePair {
  Vec3 first_axis;
  Vec3 second_axis;
  Quat between = kNoRotation;
};

// The two angles that turn `axis` (unit, in the second hinge's frame) to a direction in the frame in front of the first
// hinge; of the two solutions the one with the smaller second angle. If there is no solution, the nearest angles.
std::array<double, 2> hinge_pair_angles(const HingePair& pair, const Vec3& axis, const Vec3& direction);

}  // namespace contort
