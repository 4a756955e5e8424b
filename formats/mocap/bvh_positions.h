// Decides how the positions of a BVH are meant, because tools disagree. Blender, MotionBuilder and LAFAN1 write places
// in the parent joint, which replace OFFSET; other tools write movements, which are added to it.
//
// The numbers decide. Joints below a root hardly leave their places, so their positions are near OFFSET if they replace
// it, and near 0 if they are added: the smaller sum of distances over all joints and frames wins. A root travels. Its
// positions replace OFFSET if those of the joints below it do, or if its first frame equals its OFFSET. Otherwise the
// axis decides along which it travels least for the length of its OFFSET, mostly the height.
#pragma once

#include <array>
#include <vector>

#include "model/asset/asset.h"

namespace contort {

using PositionAxes = std::array<bool, 3>;  // true for axes with a channel

// Converts positions in the clip's translations from the file's convention to places in the parent joint. Axes without
// a channel already have OFFSET. If all joints below a root have OFFSET 0 and two or more of them have positions, the
// first frame becomes the rest pose. Remarks describe the decision where it matters.
void place_joints(std::vector<AssetNode>& nodes, const std::vector<PositionAxes>& axes, AssetClip& clip,
                  std::vector<Remark>& remarks);

}  // namespace contort
