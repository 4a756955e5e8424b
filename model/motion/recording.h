// An animation that was made elsewhere as a motion of a character: what dynamics can follow instead of what actions
// make.
//
// A joint takes over how its node has turned in the world since the model's rest pose, so that skeletons may differ in
// their frames and number of links; and where a bone leads to one other mapped bone it is first turned to lie as the
// model's does at rest, so that a figure with hanging arms can follow one that rests with its arms spread. A hinge
// takes what it can of such a turn; hinges in one point that have no nodes of their own share it as Euler angles.
// Joints without a node stay at rest. The root's path is scaled by how far both roots are at rest above the lowest
// joint that is mapped. Both shall face +Z with +Y up (glTF). A model whose root rests at the origin, as in BVH, stands
// where its lowest mapped node ever is. What joints cannot take over of their nodes is told in FollowedNode.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/asset/asset.h"
#include "model/core/result.h"
#include "model/motion/motion.h"

namespace contort {

struct RecordingUse {
  const Asset& asset;
  const AssetClip& clip;
  const std::map<std::string, std::string>& joints;  // node -> the character's joint; of others the names are equal
  double from_s = 0.0;                               // of the clip
  double rate_hz = 60.0;
  int hold_frames = 0;  // after the end
  Rigid start;          // of the model's origin in the world: a turn about +Y and a place
  // A model whose joints lie over the character's after a quarter turn or two about +Y is turned so.
  bool may_face_elsewhere = false;
  bool may_lack_root = false;  // without a node for the root, it stays where it is at rest
};

// A joint that followed a node, and the most that it left out.
struct FollowedNode {
  int joint = 0;
  int node = 0;
  int hinges = 1;           // that share the node's turn: this joint and those after it
  double missed_rad = 0.0;  // between the turn of the node and that of the joint, which may have too few axes for it
  int missed_frame = 0;
  double moved_m = 0.0;  // of a node below the root from its place at rest in its parent, in the character's size
  int moved_frame = 0;
  bool operator==(const FollowedNode&) const = default;
};

// Codes "recording.unknown_joint", "recording.unknown_node", "recording.duplicate_joint" (pointers "/joints/<node>"),
// "recording.no_root". `followed`, where it is given, gets an entry for each joint with a node, by joint.
Result<Motion> follow_recording(const Character& character, const RecordingUse& use,
                                std::vector<FollowedNode>* followed = nullptr);

// Its number of frames, held ones included; at least 1.
double frames_of(const RecordingUse& use);

}  // namespace contort
