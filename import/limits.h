// The way in which each bone turns, and how far: the kind of its joint, axes, ranges. From the table of people, from
// what the model's own clips do, or from nothing at all.
#pragma once

#include <vector>

#include "import/figure.h"

namespace contort {

// Rotations of every bone against its parent bone, from rest, in the figure's axes, in poses of the model's own clips.
struct ClipPoses {
  int pose_count = 0;
  std::vector<std::vector<Quat>> turns;  // by bone, by pose
};

ClipPoses sample_clips(const Asset& asset, const RiggedFigure& figure);

// The same figure, or its clips, seen in a mirror in the plane x = 0: right limbs become left ones, as parts are
// authored.
RiggedFigure mirrored(RiggedFigure figure);
ClipPoses mirrored(ClipPoses poses);

enum class LimitSource : std::uint8_t { table, clips, generic };

// A bone's joint: one hinge or ball, or two hinges in one point (`axis`, then `second_axis`).
struct BoneJoint {
  JointType type = JointType::ball;
  Vec3 axis{0.0, 1.0, 0.0};
  double low_deg = 0.0;
  double high_deg = 0.0;
  Vec3 swing_axis{1.0, 0.0, 0.0};
  std::array<double, 2> swing_deg{};
  Vec3 swing_center_deg{0.0};
  bool is_pair = false;
  Vec3 second_axis{0.0};
  double second_low_deg = 0.0;
  double second_high_deg = 0.0;
  LimitSource source = LimitSource::generic;
  bool leaves_table = false;  // some pose of the clips is out of the table's range
};

// The joint of a bone of the left side or the middle; others are seen in the mirror.
BoneJoint joint_of(const RiggedFigure& figure, int bone, const std::vector<Quat>& poses);

// The same poses as the joints can take them: what a hinge or an ankle cannot follow of its bone's turn, the bones that
// hang on it have to make up for.
ClipPoses followed(const RiggedFigure& figure, const ClipPoses& poses);

// Whether the bone is a foot that stands on the ground at rest.
bool is_sole_bone(const RiggedFigure& figure, int bone);

}  // namespace contort
