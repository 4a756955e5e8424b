// A figure of two legs for tests of feet in clips.
#pragma once

#include <string>
#include <vector>

#include "checks/clip_feet.h"

namespace contort::fixtures {

inline constexpr double kLegLength = 0.9;
enum PersonNode : int { kHips, kLeftThigh, kLeftShank, kLeftFoot, kLeftToe, kRightThigh, kRightShank, kRightFoot, kRightToe };

// Two legs that stand on y = 0.
inline Asset person_on_legs() {
  Asset asset;
  const auto add = [&](const std::string& name, int parent, const Vec3& place) {
    AssetNode node{.name = name, .label = name, .parent = parent, .rest = {}, .is_joint = true};
    node.rest.translation = place;
    asset.order.push_back(static_cast<int>(asset.nodes.size()));
    asset.nodes.push_back(node);
  };
  add("hips", -1, {0.0, 1.0, 0.0});
  for (const double side : {0.1, -0.1}) {
    const std::string name = side > 0.0 ? "left" : "right";
    const int thigh = static_cast<int>(asset.nodes.size());
    add(name + "_thigh", kHips, {side, 0.0, 0.0});
    add(name + "_shank", thigh, {0.0, -0.5, 0.0});
    add(name + "_foot", thigh + 1, {0.0, -0.4, 0.0});
    add(name + "_toe", thigh + 2, {0.0, -0.1, 0.15});
  }
  return asset;
}

inline const std::vector<ClipFoot> kTwoFeet = {{"left_foot", kLeftThigh, kLeftFoot, kLeftToe},
                                        {"right_foot", kRightThigh, kRightFoot, kRightToe}};

// Moves a node away from its place at rest, as a function of the time, for four seconds.
template <class Place>
void move_node(const Asset& asset, int node, Place place, AssetClip& clip) {
  AssetChannel channel;
  channel.node = node;
  for (int key = 0; key <= 240; ++key) {
    const double t_s = key / 60.0;
    const Vec3 at = asset.nodes[static_cast<std::size_t>(node)].rest.translation + place(t_s);
    channel.times_s.push_back(t_s);
    channel.values.insert(channel.values.end(), {at.x, at.y, at.z});
  }
  clip.channels.push_back(channel);
  clip.last_s = 4.0;
}

}  // namespace contort::fixtures
