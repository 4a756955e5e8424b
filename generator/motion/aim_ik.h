// Points a socket's +Z at a target, exactly and within the joints' ranges: the nearest posture of an aim table, then
// aimIK, cyclic coordinate descent over directions with every joint clamped (docs/internals/aim.md). Unlike ik.h, it
// clamps joints, because an aim must be held within their ranges; error_rad is the angle that they cannot reach.
#pragma once

#include <span>

#include "generator/motion/aim_table.h"

namespace contort {

inline constexpr double kAimReached_rad = 1e-5;

struct AimTarget {
  enum class Kind { point, direction };
  Kind kind = Kind::direction;
  Vec3 world{0.0, 0.0, 1.0};  // Metres, or a direction of any length. A direction without length is never reached.
};

struct AimResult {
  double error_rad = 0.0;  // Angle between the socket's +Z and the way from the aim point to the target, in [0, pi].
  int iterations = 0;      // Sweeps over the chain, of all starts together.
  bool reached = false;    // error_rad <= kAimReached_rad
};

// `row` and `world` belong together on entry and on return: world holds the placement of every joint at row
// (forward_kinematics), and on return that of every joint up to the last one that carries the socket; those beyond it
// that hang on the chain are stale. Only the chain's coordinates change; travels stay where they are. Nothing here
// allocates.

// Starts from the present posture; for every frame after the first. No turn about an axis is more than twice the
// error that is left, so a target that moves a little moves the joints a little. It may get stuck at limits where
// another posture would reach (0 to 25 frames of 3,000 in the tests): then `reached` is false, and aim() finds the
// other posture, to which the caller blends. Joints that are out of range on entry are brought into it; that may be a
// jump.
AimResult continue_aim(const Character& character, const AimChain& chain, std::span<Rigid> world,
                       const AimTarget& target, std::span<double> row);

// Starts from the table: from the mean of near postures, then from the nearest ones, until one reaches the target. If
// none does, the posture with the smallest error is kept. `table` must be of this chain's geometry.
AimResult aim(const Character& character, const AimChain& chain, const AimTable& table, std::span<Rigid> world,
              const AimTarget& target, std::span<double> row);

}  // namespace contort
