#include "formats/mocap/frame.h"

namespace contort {

namespace {

void turn_row(const Quat& turn, ChannelPath path, double* row) {
  if (path == ChannelPath::rotation) {
    const Quat q = turn * Quat(row[3], row[0], row[1], row[2]);
    row[0] = q.x, row[1] = q.y, row[2] = q.z, row[3] = q.w;
  } else {
    const Vec3 p = turn * Vec3(row[0], row[1], row[2]);
    row[0] = p.x, row[1] = p.y, row[2] = p.z;
  }
}

}  // namespace

void scale_lengths(double unit_m, Asset& asset) {
  for (AssetNode& node : asset.nodes) node.rest.translation *= unit_m;
  for (AssetClip& clip : asset.clips)
    for (AssetChannel& channel : clip.channels)
      if (channel.path == ChannelPath::translation)
        for (double& value : channel.values) value *= unit_m;
}

void turn_z_up(Asset& asset) {
  const Quat turn = axis_angle(Vec3(1, 0, 0), -0.5 * kPi);
  for (AssetNode& node : asset.nodes)
    if (node.parent < 0) node.rest = {turn * node.rest.translation, turn * node.rest.rotation, node.rest.scale};
  for (AssetClip& clip : asset.clips)
    for (AssetChannel& channel : clip.channels) {
      const bool is_root = asset.nodes[static_cast<std::size_t>(channel.node)].parent < 0;
      if (!is_root || channel.path == ChannelPath::scale) continue;
      const std::size_t size = row_size(channel.path);
      for (std::size_t at = 0; at < channel.values.size(); at += size)
        turn_row(turn, channel.path, channel.values.data() + at);
    }
}

}  // namespace contort
