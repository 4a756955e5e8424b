// Converts an animation that was made elsewhere to a motion of a character, which dynamics can follow instead of a
// motion that actions make.
//
// A joint takes over how its node has turned in the world since the model's rest pose, so that skeletons may differ in
// their frames and number of links; and where a bone leads to one other mapped bone it is first turned to lie as the
// model's does at rest, so that a figure with hanging arms can follow one that rests with its arms spread. A hinge
// takes the part of such a turn that is about its axis; hinges in one point that have no nodes of their own share it as
// Euler angles. Joints without a node stay at rest. The root's path is scaled by the ratio of the roots' heights at
// rest above the lowest mapped joint. Both figures must face +Z with +Y up (glTF). If a model's root rests at the
// origin, as in BVH, the ground is at the lowest place of any mapped node in the clip. FollowedNode reports the
// movement that a joint cannot take over.
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
  // Joint of the character, by node; other nodes follow by equal names. A root without a node follows the lowest node
  // that carries those of all joints.
  const std::map<std::string, std::string>& joints;
  double from_s = 0.0;                               // time in the clip at which the motion begins
  double rate_hz = 60.0;
  int hold_frames = 0;  // frames of the last pose after the end
  Rigid start;          // places the model's origin in the world: a turn about +Y and a translation
  // If turning the model by one, two or three quarters about +Y brings its joints nearer to the character's, it is
  // turned.
  bool may_face_elsewhere = false;
  bool may_lack_root = false;  // a root without a node stays where it is at rest
};

// A joint that followed a node, and the greatest movement that it could not follow.
struct FollowedNode {
  int joint = 0;
  int node = 0;
  int hinges = 1;           // number of hinges that share the node's turn: this joint and the next ones
  double missed_rad = 0.0;  // angle between the node's rotation and the joint's, which may have too few axes for it
  int missed_frame = 0;
  double moved_m = 0.0;  // distance of a node below the root from its rest place in its parent, in the character's size
  int moved_frame = 0;
  bool operator==(const FollowedNode&) const = default;
};

// Codes "recording.unknown_joint", "recording.unknown_node", "recording.duplicate_joint" (pointers "/joints/<node>"),
// "recording.no_root". `followed`, if given, gets an entry for each joint that has a node, in the order of joints.
Result<Motion> follow_recording(const Character& character, const RecordingUse& use,
                                std::vector<FollowedNode>* followed = nullptr);

// Returns the recording's number of frames, held ones included; at least 1.
double frames_of(const RecordingUse& use);

}  // namespace contort
