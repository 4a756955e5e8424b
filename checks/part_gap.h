// part_gap: a joint of a clip that is pulled out of its place. Bones keep their length and sockets their place, so the
// translation channel of a joint should have the joint's rest value. Rigs that stretch on purpose differ, so nothing is
// judged unless the user asks for it.
#pragma once

#include <vector>

#include "checks/fold.h"
#include "checks/settings.h"
#include "model/asset/asset.h"

namespace contort {

// Returns one finding, in the order of channels, for each joint that is farther from its rest place in its parent than
// `most_m` at some key; splines are also examined at eighths between keys. `most_m` is in the file's unit of length,
// which is metres in glTF. Frames are numbers of keys. Children of a skeleton's root are not judged: hips and targets
// of inverse kinematics move there. Rules of the settings for part_gap apply by node label.
std::vector<Finding> check_part_gap(const Asset& asset, const AssetClip& clip, double most_m,
                                    const CheckSettings& settings = {});

}  // namespace contort
