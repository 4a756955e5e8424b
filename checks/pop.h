// pop: a jump of a joint that the motion around it does not explain, in characters' motions as in animations made
// elsewhere. Solvers that flip, markers that are swapped and reference poses left in frame 0 make them: within one or
// two keys a joint is somewhere else, and before and after it is slow. A joint that really is too fast has to get fast
// first: its speed grows and falls over several keys. Both break the speed limit; they are reported apart because their
// cures differ.
//
// The explanation of a speed by the motion around it: with v the speeds of a channel's key intervals, a window of one
// or two intervals around i has neighbours on both sides; the faster of these is what the window stands out from. Of
// the three windows that hold i, the calmest neighbours count. Interval i is a pop where v[i] is above its limit and
// above kPopFactor times that. At the first or last key there are neighbours on one side only, and with none (a clip of
// two or three keys) nothing is a pop. Nor is a window longer than kPopLongest_s: sparse keys that an animator set are
// fast moves, not jumps.
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
inline constexpr double kBlip_rad = 5.0 * kRadPerDeg;   // people see less; no shipped clip has such a blip
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
