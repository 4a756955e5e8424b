// Findings about steps between the keys of a channel, for translation_pop and scale_pop.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checks/clip_check.h"
#include "checks/lone_steps.h"
#include "model/core/function_ref.h"

namespace contort {

// Prints a number with this many decimals, for `what` of findings.
std::string fixed_text(double value, int digits);

// Adds the time of the worst key to a finding. The key belongs to the channel of the finding's node.
KeyFinding at_key(const AssetClip& clip, ChannelPath path, Finding finding, const Asset& asset);

// Returns the steps of one channel; `apart` is the distance of two keys. The intervals' `speed_rad_s` is in units of
// the steps per second.
std::vector<SpeedInterval> step_intervals(const AssetChannel& channel,
                                          FunctionRef<double(std::size_t, std::size_t)> apart);

// Adds one finding for each run of steps that are greater than allowed. Its frames are the keys after such a step.
// `what` describes the step in words.
void add_step_findings(std::string_view check, const AssetNode& node, std::string_view unit,
                       std::span<const SpeedInterval> steps, std::span<const double> allowed,
                       const CheckSettings& settings, FunctionRef<std::string(std::size_t)> what,
                       std::vector<KeyFinding>& out);

}  // namespace contort
