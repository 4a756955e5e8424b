// The time that a part takes, at ease, from one posture to another: how long an action blends in if its use does not
// say.
#pragma once

#include "model/character/character.h"
#include "model/motion/motion.h"

namespace contort {

inline constexpr double kLeastWay_s = 0.1;  // the time that any way takes, however short
inline constexpr double kHurriedWay = 0.7;  // of the time for a way at ease: that of a course which has to hurry

// The distance between two postures of a joint: rad, or m of a travel; 0 for the root. `a` and `b` are the joint's own
// coordinates.
double joint_way(const Joint& joint, const double* a, const double* b);

// The distance with its direction: a rotation vector in a's frame for a ball, else (x, 0, 0).
Vec3 joint_way_vector(const Joint& joint, const double* a, const double* b);

// Seconds for a minimum-jerk blend in which no joint of the part is faster than half of its greatest speed; 0 if both
// postures are the same. For the root part, the root itself moves at no more than 1 m/s and 2 rad/s. `easy`: the
// greatest acceleration of each joint, rad/s^2 or m/s^2; or empty.
double way_s(const Character& character, std::size_t part, const Posture& from, const Posture& to,
             std::span<const double> easy = {});

// Seconds for a minimum-jerk blend of a root or a foot from one place to another.
double way_s(const Rigid& from, const Rigid& to);

}  // namespace contort
