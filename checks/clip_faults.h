// What is wrong with a clip in its file, so that its reader had to go around it.
#pragma once

#include <vector>

#include "checks/clip_check.h"

namespace contort {

// Those of the clip; for the first clip of a file also those that concern all clips.
std::vector<const AssetFault*> faults_of(const Asset& asset, const AssetClip& clip);

}  // namespace contort
