#include "formats/mocap/bvh_positions.h"

#include <algorithm>
#include <cmath>

namespace contort {

namespace {

// Distances of positions from OFFSET and from 0. The smaller one decides how the positions are meant.
struct Distances {
  double from_offset = 0.0;
  double from_zero = 0.0;
  bool replace_offset() const { return from_offset < from_zero; }
};

Vec3 position_at(const AssetChannel& channel, std::size_t key) {
  return {channel.values[3 * key], channel.values[3 * key + 1], channel.values[3 * key + 2]};
}

const AssetNode& node_of(const std::vector<AssetNode>& nodes, const AssetChannel& channel) {
  return nodes[static_cast<std::size_t>(channel.node)];
}

// The offset along the axes that have a channel.
Vec3 offset_of(const AssetNode& node, const PositionAxes& axes) {
  Vec3 out(0.0);
  for (int i = 0; i < 3; ++i)
    if (axes[static_cast<std::size_t>(i)]) out[i] = node.rest.translation[i];
  return out;
}

void add_distances(const AssetChannel& channel, const Vec3& offset, const PositionAxes& axes, Distances& out) {
  for (std::size_t key = 0; key < channel.times_s.size(); ++key)
    for (int i = 0; i < 3; ++i) {
      if (!axes[static_cast<std::size_t>(i)]) continue;
      out.from_offset += std::fabs(position_at(channel, key)[i] - offset[i]);
      out.from_zero += std::fabs(position_at(channel, key)[i]);
    }
}

// The travel of a root along one axis, relative to the length of its OFFSET, and its distances there.
struct AxisOfRoot {
  double travel = 0.0;
  Distances distances;
};

AxisOfRoot along(const AssetChannel& channel, const Vec3& offset, int axis) {
  AxisOfRoot out;
  double low = position_at(channel, 0)[axis], high = low;
  for (std::size_t key = 0; key < channel.times_s.size(); ++key) {
    const double p = position_at(channel, key)[axis];
    low = std::min(low, p), high = std::max(high, p);
    out.distances.from_offset += std::fabs(p - offset[axis]);
    out.distances.from_zero += std::fabs(p);
  }
  out.travel = (high - low) / std::fabs(offset[axis]);
  return out;
}

bool root_replaces_offset(const AssetChannel& channel, const Vec3& offset) {
  const Vec3 off = position_at(channel, 0) - offset;
  if (glm::dot(off, off) <= 1e-6 * glm::dot(offset, offset)) return true;
  AxisOfRoot steadiest;
  bool is_first = true;
  for (int axis = 0; axis < 3; ++axis) {
    if (offset[axis] == 0.0) continue;
    const AxisOfRoot here = along(channel, offset, axis);
    if (is_first || here.travel < steadiest.travel) steadiest = here;
    is_first = false;
  }
  return steadiest.distances.replace_offset();
}

void add_offset(const Vec3& offset, AssetChannel& channel) {
  for (std::size_t i = 0; i < channel.values.size(); ++i) channel.values[i] += offset[static_cast<int>(i % 3)];
}

// Returns true for bones without length in the hierarchy, whose lengths are in the frames.
bool are_offsets_in_frames(const std::vector<AssetNode>& nodes, const std::vector<const AssetChannel*>& inner) {
  const auto has_no_offset = [&](const AssetChannel* c) { return node_of(nodes, *c).rest.translation == Vec3(0.0); };
  const auto is_elsewhere = [](const AssetChannel* c) { return position_at(*c, 0) != Vec3(0.0); };
  return std::ranges::all_of(inner, has_no_offset) && std::ranges::count_if(inner, is_elsewhere) >= 2;
}

// Adds OFFSET if positions do not replace it.
void place_channels(const std::vector<AssetNode>& nodes, const std::vector<PositionAxes>& axes, bool below_replaces,
                    AssetClip& clip, std::vector<Remark>& remarks) {
  int replaced = 0, added = 0;
  for (AssetChannel& channel : clip.channels) {
    if (channel.path != ChannelPath::translation) continue;
    const AssetNode& node = node_of(nodes, channel);
    const Vec3 offset = offset_of(node, axes[static_cast<std::size_t>(channel.node)]);
    if (offset == Vec3(0.0)) continue;
    const bool replaces = below_replaces || (node.parent < 0 && root_replaces_offset(channel, offset));
    ++(replaces ? replaced : added);
    if (!replaces) add_offset(offset, channel);
  }
  const auto joints = [](int count) { return std::to_string(count) + (count == 1 ? " joint" : " joints"); };
  if (replaced > 0)
    remarks.push_back({"bvh.positions", "the positions of " + joints(replaced) + " replace OFFSET, being near it"});
  if (added > 0)
    remarks.push_back({"bvh.positions", "the positions of " + joints(added) + " are added to OFFSET"});
}

void rest_at_first_frame(const std::vector<const AssetChannel*>& inner, std::vector<AssetNode>& nodes) {
  for (const AssetChannel* channel : inner)
    nodes[static_cast<std::size_t>(channel->node)].rest.translation = position_at(*channel, 0);
}

}  // namespace

void place_joints(std::vector<AssetNode>& nodes, const std::vector<PositionAxes>& axes, AssetClip& clip,
                  std::vector<Remark>& remarks) {
  std::vector<const AssetChannel*> inner;
  Distances below;
  for (const AssetChannel& channel : clip.channels) {
    if (channel.path != ChannelPath::translation || node_of(nodes, channel).parent < 0) continue;
    const PositionAxes& own = axes[static_cast<std::size_t>(channel.node)];
    const Vec3 offset = offset_of(node_of(nodes, channel), own);
    inner.push_back(&channel);
    if (offset != Vec3(0.0)) add_distances(channel, offset, own, below);
  }
  place_channels(nodes, axes, below.replace_offset(), clip, remarks);
  if (!are_offsets_in_frames(nodes, inner)) return;
  rest_at_first_frame(inner, nodes);
  remarks.push_back({"bvh.no_offsets", "all OFFSETs below the root are 0; the first frame is the rest pose"});
}

}  // namespace contort
