// Reads AMC (Acclaim motion capture): the numbers of a motion, for the degrees of freedom of an ASF skeleton.
#pragma once

#include <string>
#include <string_view>

#include "model/asset/asset.h"
#include "model/asset/capture.h"
#include "model/core/result.h"

namespace contort {

// Every bone with degrees of freedom must have its line in every frame. Codes "amc.*"; the pointer is a line.
Result<AmcMotion> read_amc(const std::string& path, const AsfSkeleton& skeleton);
Result<AmcMotion> parse_amc(std::string_view text, const AsfSkeleton& skeleton);

// Converts a motion to nodes and one clip, in the skeleton's unit of length. A node is where its bone begins. At rest
// nothing is turned; in motion a bone turns by C * R * C^-1, with C the bone's axis and R the product of its degrees
// of freedom. Bones that stretch ("l") keep their length here. `rate_hz` > 0 is needed because an AMC file does not
// state it.
Asset to_asset(const AsfSkeleton& skeleton, const AmcMotion& motion, double rate_hz, const std::string& clip_name);

}  // namespace contort
