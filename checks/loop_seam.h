// loop_seam: a clip that is played in a loop must end as it begins. Per rotation channel, the angle between its last
// and its first key is judged. Authors close loops in two ways: the last key repeats the first one, or is the key
// before it. The seam may therefore be twice as wide as the larger of the neighbouring steps, and is always allowed 1
// degree.
#pragma once

#include <vector>

#include "checks/fold.h"
#include "checks/settings.h"
#include "model/asset/asset.h"

namespace contort {

inline constexpr double kSeam_rad = 1.0 * kRadPerDeg;  // invisible to people
inline constexpr double kSeamFactor = 2.0;

// One finding for each node whose seam is wider, in the order of channels; frames are the number of the last key. Rules
// of the settings for loop_seam apply by node label. Channels with fewer than three keys have no seam.
std::vector<Finding> check_loop_seam(const Asset& asset, const AssetClip& clip, const CheckSettings& settings = {});

}  // namespace contort
