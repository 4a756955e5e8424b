// The figure of a clip at rest: its size, and lengths of movements of nodes, both in the world.
#pragma once

#include <vector>

#include "model/asset/asset.h"

namespace contort {

struct ClipFigure {
  std::vector<Mat4> world_from_node;  // at rest, by node
  double size_m = 0.0;  // diagonal of the box around all joints, or around all nodes if there are no joints
};

ClipFigure clip_figure(const Asset& asset);

// Returns the transforms of all nodes for another pose: parent_from_node of every node, as in model/asset/sample.h.
std::vector<Mat4> world_from_nodes(const Asset& asset, const std::vector<Trs>& local);

// Converts a change of a node's translation to the world, in the model's rest pose.
Vec3 in_world(const Asset& asset, const ClipFigure& figure, int node, const Vec3& change);

}  // namespace contort
