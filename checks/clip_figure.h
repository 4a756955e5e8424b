// The figure of a clip at rest, in the world: how large it is, and how long a movement of a node is there.
#pragma once

#include <vector>

#include "model/asset/asset.h"

namespace contort {

struct ClipFigure {
  std::vector<Mat4> world_from_node;  // at rest, by node
  double size_m = 0.0;                // the diagonal of the box around the joints; around all nodes if none is a joint
};

ClipFigure clip_figure(const Asset& asset);

// A change of a node's translation, as the model at rest has it in the world.
Vec3 in_world(const Asset& asset, const ClipFigure& figure, int node, const Vec3& change);

}  // namespace contort
