// Samples clips: values between keys, whole poses, and the speeds of joints.
#pragma once

#include <vector>

#include "model/asset/asset.h"

namespace contort {

// Returns the channel's value at a time; before the first key and after the last one, the value of that key. Linear
// rotations take the shorter arc, and splines are normalised, both by the glTF standard (appendix C). sample_rotation
// is for rotation channels, sample_vector for the others.
Quat sample_rotation(const AssetChannel& channel, double t_s);
Vec3 sample_vector(const AssetChannel& channel, double t_s);

// Returns parent_from_node of every node, in the asset's order of nodes: at rest, unless the clip moves it.
std::vector<Trs> pose(const Asset& asset, const AssetClip& clip, double t_s);

struct SpeedInterval {
  double t0_s = 0.0;
  double t1_s = 0.0;
  double speed_rad_s = 0.0;  // Rotation angle, the short way, divided by time.
  bool operator==(const SpeedInterval&) const = default;
};

// Speeds are those that a display shows, which are finite. A display shows a frame for 1/60 s, or shorter, down to
// 1/240 s, if the keys of a channel are closer on average. A STEP channel with at least 12 keys a second is a sampled
// motion, and its keys are frames.
struct ChannelSpeeds {
  int channel = 0;  // Index of the channel in the clip.
  int node = 0;
  // True for a STEP channel that is not a sampled motion: the pose jumps from key to key, without motion in between.
  bool jumps = false;
  // One entry for each pair of neighbouring keys: the speed between them. If keys are closer than a frame, it is the
  // speed of a frame with both. STEP channels hold the first key; their entry is the jump to the second, in the frame
  // before it.
  std::vector<SpeedInterval> between_keys;
  // The true peaks of splines, which may rotate faster inside an interval than between its keys: one entry for each of
  // between_keys, at most 1 % too slow, with the frame around the peak. Empty for other interpolations.
  std::vector<SpeedInterval> within_keys;
  bool operator==(const ChannelSpeeds&) const = default;
};

// The channel must be a rotation.
ChannelSpeeds channel_speeds(const AssetClip& clip, int channel);

// Returns one entry for each rotation channel, in the clip's order.
std::vector<ChannelSpeeds> joint_speeds(const AssetClip& clip);

}  // namespace contort
