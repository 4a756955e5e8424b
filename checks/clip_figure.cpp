#include "checks/clip_figure.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "model/core/index.h"

namespace contort {

namespace {

Mat4 matrix_of(const Trs& trs) {
  Mat4 out = glm::mat4_cast(trs.rotation);
  for (int i = 0; i < 3; ++i) out[i] *= trs.scale[i];
  out[3] = glm::dvec4(trs.translation, 1.0);
  return out;
}

}  // namespace

std::vector<Mat4> world_from_nodes(const Asset& asset, const std::vector<Trs>& local) {
  std::vector<Mat4> out(asset.nodes.size(), Mat4(1.0));
  for (const int node : asset.order) {
    const Mat4 own = matrix_of(local[at(node)]);
    const int parent = asset.nodes[at(node)].parent;
    out[at(node)] = parent < 0 ? own : out[at(parent)] * own;
  }
  return out;
}

ClipFigure clip_figure(const Asset& asset) {
  ClipFigure out;
  std::vector<Trs> rest;
  for (const AssetNode& node : asset.nodes) rest.push_back(node.rest);
  out.world_from_node = world_from_nodes(asset, rest);
  const bool has_joints = std::ranges::any_of(asset.nodes, &AssetNode::is_joint);
  Vec3 low(1e300), high(-1e300);
  for (std::size_t i = 0; i < asset.nodes.size(); ++i) {
    if (has_joints && !asset.nodes[i].is_joint) continue;
    const Vec3 place(out.world_from_node[i][3]);
    low = glm::min(low, place), high = glm::max(high, place);
  }
  const Vec3 diagonal = high - low;
  if (!asset.nodes.empty()) out.size_m = std::sqrt(glm::dot(diagonal, diagonal));
  return out;
}

Vec3 in_world(const Asset& asset, const ClipFigure& figure, int node, const Vec3& change) {
  const int parent = asset.nodes[at(node)].parent;
  return parent < 0 ? change : Vec3(figure.world_from_node[at(parent)] * glm::dvec4(change, 0.0));
}

}  // namespace contort
