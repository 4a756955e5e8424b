// Decides where the positions of a BVH are: tools do not agree. Blender, MotionBuilder and LAFAN1 write places in the
// joint above, which replace OFFSET; others write movements, which are added to it.
//
// The file tells by its numbers. Joints below a root hardly leave their places, so that their positions are near OFFSET
// where they replace it, and near 0 where they are added: the smaller sum of distances over all joints and frames
// decides. A root travels. If the joints below it replace OFFSET, or if its first frame is its OFFSET, it replaces it,
// too; else the axis decides along which it travels least for the length of its OFFSET, mostly the height.
#pragma once

#include <array>
#include <vector>

#include "model/asset/asset.h"

namespace contort {

using PositionAxes = std::array<bool, 3>;  // those that have a channel

// Turns positions as the file has them, in the clip's translations, into places in the joint above. Axes without a
// channel have OFFSET there already. Where all joints below a root have OFFSET 0 and two or more have positions, the
// first frame becomes the rest pose. Remarks say how it was decided, where that makes a difference.
void place_joints(std::vector<AssetNode>& nodes, const std::vector<PositionAxes>& axes, AssetClip& clip,
                  std::vector<Remark>& remarks);

}  // namespace contort
