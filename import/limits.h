// Determines the joint of each bone: its type, axes and ranges. The values come from a table for humans, from the
// model's own clips, or from defaults.
#pragma once

#include <vector>

#include "import/figure.h"

namespace contort {

// The rotations of every bone relative to its parent bone, from rest, in the figure's axes, in poses of the model's
// own clips.
struct ClipPoses {
  int pose_count = 0;
  std::vector<std::vector<Quat>> turns;  // by bone, by pose
};

ClipPoses sample_clips(const Asset& asset, const RiggedFigure& figure);

// Returns the figure, or its clips, mirrored in the plane x = 0: right limbs become left ones, as parts are authored.
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
  bool leaves_table = false;  // some pose of the clips is outside of the range in the table
};

// Returns the joint of a bone of the left side or the middle; for the right side, mirror the figure first.
BoneJoint joint_of(const RiggedFigure& figure, int bone, const std::vector<Quat>& poses);

// Returns the poses that the joints can follow: the part of a bone's rotation that its hinge or ankle cannot follow is
// passed on to the bones attached to it.
ClipPoses followed(const RiggedFigure& figure, const ClipPoses& poses);

// Returns true if the bone is a foot that stands on the ground at rest.
bool is_sole_bone(const RiggedFigure& figure, int bone);

}  // namespace contort
