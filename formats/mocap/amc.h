// AMC (Acclaim motion capture): the numbers of a motion, for the degrees of freedom of an ASF skeleton.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mocap/asf.h"
#include "model/asset/asset.h"

namespace contort {

struct AmcMotion {
  int first_frame = 0;  // As the file numbers it: 1 in most. Frames are numbered without a gap.
  int frame_count = 0;
  int dof_count = 0;  // Of all bones, root included.
  std::vector<double>
      values;  // Frame by frame; in a frame bone by bone in the skeleton's order, not the AMC's. In rad.
  bool operator==(const AmcMotion&) const = default;

  std::span<const double> row(int frame) const {
    const auto dofs = static_cast<std::size_t>(dof_count);
    return std::span(values).subspan(static_cast<std::size_t>(frame) * dofs, dofs);
  }
};

// Every bone with degrees of freedom must have its line in every frame. Codes "amc.*"; the pointer is a line.
Result<AmcMotion> read_amc(const std::string& path, const AsfSkeleton& skeleton);
Result<AmcMotion> parse_amc(std::string_view text, const AsfSkeleton& skeleton);

// As nodes and one clip, in the skeleton's unit of length. A node is where its bone begins; at rest nothing is turned,
// and in motion a bone turns by C * R * C^-1, with C the bone's axis and R the product of its degrees of freedom. Bones
// that stretch ("l") keep their length here. `rate_hz` > 0: an AMC file does not say it.
Asset to_asset(const AsfSkeleton& skeleton, const AmcMotion& motion, double rate_hz, const std::string& clip_name);

}  // namespace contort
