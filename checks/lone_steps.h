// Steps between keys that stand alone: the joint leaves its place for a key or two and comes back (a blip), or it
// changes its place for good (a jump), while for half a second before and after it hardly moves by comparison. Intended
// style looks different: a blow, a run or a stop at a pose is fast over several keys, or repeats. In 235 published
// clips these rules flag one intended movement, a jump of five keys.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/asset/sample.h"
#include "model/core/function_ref.h"

namespace contort {

// Smaller blips and jumps are not findings. In the unit of the steps: rad, m, or a logarithm.
struct LoneLimits {
  double blip = 0.0;
  double jump = 0.0;
};

inline constexpr double kLoneAround_s = 0.5;   // a step is compared with the motion up to this time before and after it
inline constexpr double kLongestBlip_s = 0.13;  // three frames at 24 Hz: two keys that are off
inline constexpr double kBlipFactor = 4.0;      // a blip is at least this many times every other step
inline constexpr double kJumpFactor = 8.0;      // a jump is at least this many times every other step, and kBlipFactor
                                                // times the two beside it

// Returns the limits for a channel of this interpolation. A STEP channel consists of jumps, so only its blips are
// judged.
LoneLimits lone_limits(Interpolation interpolation, const LoneLimits& limits);

// Returns for each interval the largest step that would not stand alone; infinite where nothing is judged: an interval
// of more than kPopLongest_s, or with fewer than four others to compare with. `apart` is the distance of two keys.
std::vector<double> allowed_lone_steps(std::span<const SpeedInterval> between_keys,
                                       FunctionRef<double(std::size_t, std::size_t)> apart, const LoneLimits& limits);

}  // namespace contort
