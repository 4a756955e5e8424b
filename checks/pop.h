// pop: a jump of a joint that the motion around it does not explain, in characters' motions as in animations made
// elsewhere. Flipping solvers, swapped markers and reference poses left in frame 0 cause pops: within one or two keys a
// joint is in another place, and it is slow before and after. A real movement that is too fast must accelerate first:
// its speed grows and falls over several keys. Both break the speed limit; they are reported separately because they
// are repaired differently.
//
// The surrounding motion explains a speed as follows. Let v be the speeds of a channel's key intervals. For each of the
// three windows of one or two intervals that contain interval i, take the faster of the intervals just before and just
// after the window; let s be the smallest of these values. Interval i is a pop if v[i] is above its limit and above
// kPopFactor * s. At the first or last key there is a neighbour on one side only, and without any neighbour (a clip of
// two or three keys) nothing is a pop. Neither is a window longer than kPopLongest_s: sparse keys that an animator set
// are fast moves, not jumps.
#pragma once

#include <cstddef>
#include <span>

#include "model/asset/sample.h"
#include "model/motion/motion.h"

namespace contort {

// Real moves reach 3: a quick arm sampled at 30 Hz turns at 650, 1970, 480 deg/s in a row. Pops mostly exceed 10.
inline constexpr double kPopFactor = 4.0;
// Two frames at 24 Hz last 83 ms. People need longer to start and stop a limb.
inline constexpr double kPopLongest_s = 0.1;

// Below the limit, in clips as they are in their files: a step that stands alone (lone_steps.h), and a leap that the
// motion around it does not explain. 90 degrees in a frame of 30 Hz are 2,700 deg/s, less than the fastest real moves.
inline constexpr double kBlip_rad = 5.0 * kRadPerDeg;   // people notice smaller blips; no published clip has one of 5°
inline constexpr double kJump_rad = 20.0 * kRadPerDeg;
inline constexpr double kLeap_rad = 85.0 * kRadPerDeg;

// The speed that the surrounding motion explains for interval i, rad/s; infinite if there are no neighbours to
// compare with.
double explained_rad_s(std::span<const SpeedInterval> between_keys, std::size_t i);

// The speed of a joint from the previous frame to `frame` >= 1, and the speed that the motion around that step
// explains; rad/s, or m/s for prismatic joints.
double speed_into(const Motion& motion, const Joint& joint, int frame);
double explained_speed(const Motion& motion, const Joint& joint, int frame);

}  // namespace contort
