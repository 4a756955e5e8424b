// Samples clips: values between keys, whole poses, and the speeds of joints.
#pragma once

#include <vector>

#include "model/asset/asset.h"

namespace contort {

// Returns the channel's value at a time; before the first key and after the last one, the value of that key. Linear
// rotations take the shorter arc, and splines are normalised, both by the glTF standard (appendix C). The channel
// must be a rotation, or none.
Quat sample_rotation(const AssetChannel& channel, double t_s);
Vec3 sample_vector(const AssetChannel& channel, double t_s);

// Returns parent_from_node of every node, in the asset's order of nodes: at rest, except where the clip moves it.
std::vector<Trs> pose(const Asset& asset, const AssetClip& clip, double t_s);

struct SpeedInterval {
  double t0_s = 0.0;
  double t1_s = 0.0;
  double speed_rad_s = 0.0;  // Angle, the short way, over time. Infinite for a turn in no time.
  bool operator==(const SpeedInterval&) const = default;
};

struct ChannelSpeeds {
  int channel = 0;  // Index into the clip.
  int node = 0;
  // The speeds between each pair of neighbouring keys. For STEP channels, which jump, this is the speed of a joint
  // that would use all the time between the keys.
  std::vector<SpeedInterval> between_keys;
  // The speeds in eight parts of each interval, because splines may turn faster inside than between the keys. Empty
  // for other interpolations.
  std::vector<SpeedInterval> within_keys;
  bool operator==(const ChannelSpeeds&) const = default;
};

// Returns one entry for each rotation channel, in the clip's order.
std::vector<ChannelSpeeds> joint_speeds(const AssetClip& clip);

}  // namespace contort
