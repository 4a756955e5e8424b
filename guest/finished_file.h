// A finished animation file as a generator of one motion: a clip becomes an Execution of a character, without an
// intent, because the file has none. Data that the conversion cannot take over are listed in the result, and never
// dropped silently (docs/reference/checks.md).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/asset/asset.h"
#include "model/core/result.h"
#include "model/motion/execution.h"
#include "model/motion/recording.h"

namespace contort {

struct FinishedFile {
  const Asset& asset;
  const AssetClip& clip;
  std::shared_ptr<const Character> character;
  const std::map<std::string, std::string>& joints;  // node -> the character's joint; unknown nodes are ignored
  double rate_hz = 0.0;                              // 0: own_rate_hz
};

struct Conversion {
  Execution execution;
  std::vector<FollowedNode> followed;  // for each joint with a node: the node, and the movement that is left out
  std::vector<int> stray_nodes;        // indices of nodes that the clip moves and no joint follows
  std::vector<int> joints_at_rest;     // joints that follow no node
};

// Returns the frames per second at which keys fall on frames: one frame for each of the shortest steps between keys if
// that gives at most 240, else the key rate of the densest channel. A rate below 30 is multiplied by a whole number, so
// that the motion between sparse keys is judged too. 30 for clips of a single pose.
double own_rate_hz(const AssetClip& clip);

// The ground is level, at the height where the model stands at rest. Without a node for the root the figure stays in
// place, and its path is unknown. It walks on the spot if the root stays within a quarter of its height at rest while
// two feet at least are pulled the same way over the ground, each by more than a tenth of that height. Codes
// "check.nothing_matches" (no joint but the root has a node), "check.too_long" (more than 100,000 frames),
// "recording.unknown_joint" and "recording.duplicate_joint".
Result<Conversion> convert(const FinishedFile& file);

}  // namespace contort
