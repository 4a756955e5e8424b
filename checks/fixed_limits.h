// Limits of checks that are the same for every character. Others follow from its joints.
#pragma once

#include "model/core/math.h"

namespace contort {

inline constexpr double kAimLimit_rad = 0.1 * kRadPerDeg;
inline constexpr double kShortestRise_s = 0.02;  // shortest time from rest to a joint's greatest speed
inline constexpr double kSlide_m = 0.02;         // greatest slide of a foot on the ground
inline constexpr double kSink_m = 0.005;         // greatest depth in the ground; soles are soft, and colliders are
                                                 // coarse, to about this extent
inline constexpr double kPress_m = 0.005;        // greatest depth in an obstacle
inline constexpr double kReachLimit_m = 0.001;
inline constexpr double kLeft_rad = 0.1 * kRadPerDeg;  // greatest offset that an additive action may leave behind
inline constexpr double kBack_rad = 3.0 * kRadPerDeg;  // greatest distance of a joint from its target once the time
                                                       // after an impact is over
inline constexpr double kBack_m = 0.01;                // greatest distance of a prismatic joint from its target, once
                                                       // that time is over

// Margins of `balance` where there is no zero moment point.
inline constexpr double kTipping_m = -0.05;  // the figure is on an edge of its feet
inline constexpr double kAirborne_m = -0.1;  // it is off the ground
inline constexpr double kFallen_m = -1.0;    // it fell; no margin is lower

}  // namespace contort
