// The figure of a clip at rest: its size, and the length of a node's movement, both in the world.
#pragma once

#include <vector>

#include "model/asset/asset.h"

namespace contort {

struct ClipFigure {
  std::vector<Mat4> world_from_node;  // at rest, by node
  double size_m = 0.0;                // the diagonal of the box around the joints; around all nodes if none is a joint
};

ClipFigure clip_figure(const Asset& asset);

// The same for another pose: parent_from_node of every node, as model/asset/sample.h gives it.
std::vector<Mat4> world_from_nodes(const Asset& asset, const std::vector<Trs>& local);

// A change of a node's translation, as the model at rest has it in the world.
Vec3 in_world(const Asset& asset, const ClipFigure& figure, int node, const Vec3& change);

}  // namespace contort
