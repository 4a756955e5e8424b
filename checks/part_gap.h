// part_gap: a joint of a clip that is pulled out of its place. Bones keep their length and sockets their place, so a
// translation channel of a joint should say what the joint has at rest; rigs that stretch on purpose do not, which is
// why nothing is judged unless somebody asks for it.
#pragma once

#include <vector>

#include "checks/fold.h"
#include "checks/settings.h"
#include "model/asset/asset.h"

namespace contort {

// One finding for each joint that is farther from its place at rest in its parent than `most_m` (metres, as glTF
// says; lengths are in the unit of the file)
// at some key, splines also at eighths between keys; in the order of channels. Frames are numbers of keys. Joints that
// hang on the root of a skeleton are not judged: hips, and what inverse kinematics is aimed at, are moved there. Rules
// of the settings for part_gap apply by node label.
std::vector<Finding> check_part_gap(const Asset& asset, const AssetClip& clip, double most_m,
                                    const CheckSettings& settings = {});

}  // namespace contort
