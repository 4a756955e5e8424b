// Reads BVH (Biovision hierarchy): a skeleton and one clip, as text. Files are hostile until proven otherwise: whatever
// the bytes are, the answer is a checked Asset or one Issue, within the limits of limits.h. There is no standard; this
// reader takes what the files of ten tools have in common, and where they differ, what follows.
//
// * Nodes are the joints and end sites in the file's order; an end site is named "<joint> End Site". Offsets are rest
//   translations, in the file's unit of length; at rest nothing is turned.
// * A rotation is the product of the joint's rotation channels as they are listed: Zrotation Xrotation Yrotation is
//   Rz * Rx * Ry. Each joint has its own order, and positions may stand before, after or between.
// * Positions replace the offset or are added to it, whichever the file means (bvh_positions.h).
// * Each frame is one line with one number per channel. Key i is at i times the frame time, between keys it is linear.
// * The lines that there are count, not "Frames:", and a last line that breaks off is left out; a remark says so.
// * Several roots are one asset. "Frames: 0" without lines is a skeleton without a clip.
#pragma once

#include <string>
#include <string_view>

#include "model/asset/asset.h"
#include "model/core/result.h"

namespace contort {

// The clip has the file's name, without folder and ending. Codes "bvh.*"; the pointer is a line: "line 12". If
// `rate_hz` is above 0, it replaces "Frame Time:".
Result<Asset> read_bvh(const std::string& path, double rate_hz = 0.0);

Result<Asset> parse_bvh(std::string_view text, const std::string& clip_name, double rate_hz = 0.0);

}  // namespace contort
