// Steps between keys that stand alone: the joint is somewhere else at one key and back at the next (a blip), or it is
// somewhere else from then on (a jump), while for half a second before and after it hardly moves by comparison. Style
// does not look like that: a blow, a run or a stop at a pose is fast over several keys, and comes again. Of 235 clips
// that people ship, one has such a step that is no fault of the data, a jump of five keys.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/asset/sample.h"
#include "model/core/function_ref.h"

namespace contort {

// Blips and jumps smaller than these are no findings, in the unit of the steps: rad, m, or a logarithm.
struct LoneLimits {
  double blip = 0.0;
  double jump = 0.0;
};

inline constexpr double kLoneAround_s = 0.5;   // of motion on either side is what a step is compared with
inline constexpr double kLongestBlip_s = 0.13;  // three frames at 24 Hz: two keys that are off
inline constexpr double kBlipFactor = 4.0;      // times every other step
inline constexpr double kJumpFactor = 8.0;      // times every other step, and kBlipFactor times the two beside it

// Returns the limits for a channel of this interpolation. A STEP channel consists of jumps, so only its blips are judged.
LoneLimits lone_limits(Interpolation interpolation, const LoneLimits& limits);

// Returns for each interval the largest step that would not stand alone; infinite where nothing is judged: an interval
// of more than kPopLongest_s, or with fewer than four others to compare with. `apart` is the distance of two keys.
std::vector<double> allowed_lone_steps(std::span<const SpeedInterval> between_keys,
                                       FunctionRef<double(std::size_t, std::size_t)> apart, const LoneLimits& limits);

}  // namespace contort
