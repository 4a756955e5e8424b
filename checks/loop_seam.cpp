#include "checks/loop_seam.h"

#include <algorithm>

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

}  // namespace

std::vector<Finding> check_loop_seam(const Asset& asset, const AssetClip& clip, const CheckSettings& settings) {
  std::vector<Finding> findings;
  for (const AssetChannel& channel : clip.channels) {
    if (channel.path != ChannelPath::rotation || channel.times_s.size() < 3) continue;
    const std::string& node = asset.nodes[static_cast<std::size_t>(channel.node)].label;
    const double margin = margin_rad(channel) + tolerance_of(settings, "loop_seam", node);
    const int last = static_cast<int>(channel.times_s.size()) - 1;
    if (margin < 0.0)
      findings.push_back({"loop_seam", node, "rad", last, last, last, margin, -margin / kSeamScale_rad});
  }
  return findings;
}

}  // namespace contort
