// Findings about steps between the keys of a channel: what translation_pop and scale_pop share.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checks/clip_check.h"
#include "checks/lone_steps.h"
#include "model/core/function_ref.h"

namespace contort {

// With so many digits behind the point, for `what` of findings.
std::string fixed_text(double value, int digits);

// A finding with the time of its worst key, which is one of the channel of the node that it is about.
KeyFinding at_key(const AssetClip& clip, ChannelPath path, Finding finding, const Asset& asset);

// The steps of one channel, where `apart` is the distance of two keys. `speed_rad_s` of the intervals is in the unit of
// the steps per second.
std::vector<SpeedInterval> step_intervals(const AssetChannel& channel,
                                          FunctionRef<double(std::size_t, std::size_t)> apart);

// One finding for each run of steps that are greater than allowed. Frames of findings are the keys that are off: those
// after a step. `what` says the step in words.
void add_step_findings(std::string_view check, const AssetNode& node, std::string_view unit,
                       std::span<const SpeedInterval> steps, std::span<const double> allowed,
                       const CheckSettings& settings, FunctionRef<std::string(std::size_t)> what,
                       std::vector<KeyFinding>& out);

}  // namespace contort
