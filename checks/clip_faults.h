// The faults in a clip's file that the reader skipped.
#pragma once

#include <vector>

#include "checks/clip_check.h"

namespace contort {

// Returns the faults of the clip; for the first clip of a file also those that concern all clips.
std::vector<const AssetFault*> faults_of(const Asset& asset, const AssetClip& clip);

}  // namespace contort
