#include "checks/loop_seam.h"

#include <algorithm>

#include "checks/clip_check.h"
#include "model/asset/sample.h"

namespace contort {

namespace {

double angle_between(const AssetChannel& channel, std::size_t key_a, std::size_t key_b) {
  const Quat a = sample_rotation(channel, channel.times_s[key_a]);
  const Quat b = sample_rotation(channel, channel.times_s[key_b]);
  return rotation_angle(glm::conjugate(a) * b);
}

double margin_rad(const AssetChannel& channel) {
  const std::size_t last = channel.times_s.size() - 1;
  const double widest = std::max(angle_between(channel, 0, 1), angle_between(channel, last - 1, last));
  return std::max(kSeam_rad, kSeamFactor * widest) - angle_between(channel, last, 0);
}

bool has_seam(const AssetChannel& channel) {
  return channel.path == ChannelPath::rotation && channel.times_s.size() >= 3;
}

}  // namespace

std::vector<Finding> check_loop_seam(const Asset& asset, const AssetClip& clip, const CheckSettings& settings) {
  const double scale = find_check("loop_seam").scale;
  std::vector<Finding> findings;
  for (const AssetChannel& channel : clip.channels) {
    if (!has_seam(channel)) continue;
    const std::string& node = asset.nodes[static_cast<std::size_t>(channel.node)].label;
    const double margin = margin_rad(channel) + tolerance_of(settings, "loop_seam", node);
    const int last = static_cast<int>(channel.times_s.size()) - 1;
    if (margin < 0.0) findings.push_back({"loop_seam", node, "rad", last, last, last, margin, -margin / scale});
  }
  return findings;
}

ClipCheckResult loop_seam_in_clip(const ClipInput& in) {
  if (!in.is_loop) return {0, "nothing says that the clip is a loop (--loops)", {}};
  const auto seams = static_cast<int>(std::ranges::count_if(in.clip.channels, has_seam));
  if (seams == 0) return {0, "no rotation has three keys", {}};
  return {seams, "", check_loop_seam(in.asset, in.clip, in.settings)};
}

}  // namespace contort
