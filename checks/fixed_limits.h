// Limits of checks that are the same for every character. Others follow from its joints.
#pragma once

#include "model/core/math.h"

namespace contort {

inline constexpr double kAimLimit_rad = 0.1 * kRadPerDeg;
inline constexpr double kShortestRise_s = 0.02;  // from rest to a joint's greatest speed
inline constexpr double kSlide_m = 0.02;         // of a foot on the ground
inline constexpr double kSink_m = 0.005;         // into the ground: soles are as soft, and colliders as coarse
inline constexpr double kPress_m = 0.005;        // into an obstacle
inline constexpr double kReachLimit_m = 0.001;
inline constexpr double kLeft_rad = 0.1 * kRadPerDeg;  // of an additive action that is over
inline constexpr double kBack_rad = 3.0 * kRadPerDeg;  // distance of a joint from its target in time after an impact
inline constexpr double kBack_m = 0.01;                // the same for prismatic joints

}  // namespace contort
