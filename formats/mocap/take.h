// A take of motion capture in two files: a motion (AMC) and its skeleton (ASF).
#pragma once

#include <string>

#include "model/asset/asset.h"
#include "model/asset/capture.h"
#include "model/core/result.h"

namespace contort {

inline constexpr double kTakeRate_hz = 120.0;  // usual frame rate of takes, which do not state it

struct Take {
  AsfSkeleton skeleton;
  AmcMotion motion;
};

// Reads both files. Without `asf_path` the skeleton is found beside the motion; it must be inside that folder, because
// it may be a link that came with the take. Codes "amc.*" and "asf.*", and those of find_skeleton.
Result<Take> read_take(const std::string& amc_path, const std::string& asf_path = "");

// The take as nodes and one clip that has the motion's name.
Asset to_asset(const Take& take, double rate_hz, const std::string& amc_path);

// The only .asf in the folder of an .amc; of several, the one whose name has the longest beginning in common. Code
// "check.no_skeleton" if the folder has no .asf, or if several have equally similar names.
Result<std::string> find_skeleton(const std::string& amc_path);

}  // namespace contort
