#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "formats/gltf/from_model.h"
#include "formats/gltf/limits.h"
#include "model/asset/labels.h"

namespace contort {

namespace {

std::string node_pointer(std::size_t node) { return "/nodes/" + std::to_string(node); }

// ---- transforms

using Axes = std::array<Vec3, 3>;

// Completes columns of scale 0 with directions at right angles to the others. Any will do, because the scale hides
// them.
void complete(Axes& axes, const std::array<bool, 3>& known) {
  const int count = known[0] + known[1] + known[2];
  if (count == 0) axes = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    if (count == 2 && !known[i]) axes[i] = glm::cross(axes[j], axes[k]);
    if (count == 1 && known[i]) axes[j] = perpendicular(axes[i]);
    if (count == 1 && known[i]) axes[k] = glm::cross(axes[i], axes[j]);
  }
}

// Exporters write products of several 32-bit rotations, with errors of 1e-6. A shear that matters is larger.
bool are_perpendicular(const Axes& axes) {
  constexpr double kTolerance = 1e-3;
  return std::fabs(glm::dot(axes[0], axes[1])) < kTolerance && std::fabs(glm::dot(axes[1], axes[2])) < kTolerance &&
         std::fabs(glm::dot(axes[2], axes[0])) < kTolerance;
}

bool last_row_is_affine(std::span<const double> m) {
  return std::fabs(m[3]) + std::fabs(m[7]) + std::fabs(m[11]) + std::fabs(m[15] - 1.0) < 1e-6;
}

// Returns false for a quaternion whose length differs too much from 1 for a rotation; the standard requires 1.
bool read_unit(const std::vector<double>& xyzw, Quat& out) {
  const double length = std::sqrt(xyzw[0] * xyzw[0] + xyzw[1] * xyzw[1] + xyzw[2] * xyzw[2] + xyzw[3] * xyzw[3]);
  if (!(std::fabs(length - 1.0) <= kUnitTolerance)) return false;
  out = Quat(xyzw[3] / length, xyzw[0] / length, xyzw[1] / length, xyzw[2] / length);
  return true;
}

Vec3 read_vector(const std::vector<double>& xyz, const Vec3& fallback) {
  return xyz.empty() ? fallback : Vec3(xyz[0], xyz[1], xyz[2]);
}

bool is_moderate(const std::vector<double>& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::fabs(number) <= kMaxGltfLength; });
}

Result<Trs> read_transform(const tinygltf::Node& node, const std::string& pointer) {
  Trs out;
  if (!is_moderate(node.matrix) || !is_moderate(node.translation) || !is_moderate(node.scale))
    return Issue{"gltf.out_of_range", pointer, "allowed are places, scales and matrices of numbers up to 1e100"};
  if (!node.matrix.empty()) {
    if (decompose(node.matrix, out)) return out;
    return Issue{"gltf.bad_node", pointer + "/matrix", "allowed is a product of translation, rotation and scale only"};
  }
  out.translation = read_vector(node.translation, out.translation);
  out.scale = read_vector(node.scale, out.scale);
  if (!node.rotation.empty() && !read_unit(node.rotation, out.rotation))
    return Issue{"gltf.not_unit", pointer + "/rotation", "allowed is a quaternion of length 1, give or take 1 %"};
  return out;
}

// ---- the forest

Result<Done> read_parents(const tinygltf::Model& model, Asset& asset) {
  for (std::size_t parent = 0; parent < model.nodes.size(); ++parent) {
    const std::vector<int>& children = model.nodes[parent].children;
    for (std::size_t i = 0; i < children.size(); ++i) {
      int& known = asset.nodes[static_cast<std::size_t>(children[i])].parent;
      if (known >= 0)
        return Issue{"gltf.two_parents", node_pointer(parent) + "/children/" + std::to_string(i),
                     "node " + std::to_string(children[i]) + " is a child of node " + std::to_string(known) +
                         " already; allowed is one parent"};
      known = static_cast<int>(parent);
    }
  }
  return Done{};
}

// Visits parents before children, with a stack of our own, because a file may nest as deep as it has nodes.
void visit_tree(const tinygltf::Model& model, int root, std::vector<int>& order) {
  std::vector<int> open = {root};
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    order.push_back(node);
    const std::vector<int>& children = model.nodes[static_cast<std::size_t>(node)].children;
    open.insert(open.end(), children.rbegin(), children.rend());
  }
}

// Every node has at most one parent, so nodes that no root reaches are on a cycle or below one.
Result<Done> read_order(const tinygltf::Model& model, Asset& asset) {
  for (std::size_t i = 0; i < asset.nodes.size(); ++i)
    if (asset.nodes[i].parent < 0) visit_tree(model, static_cast<int>(i), asset.order);
  if (asset.order.size() == asset.nodes.size()) return Done{};
  const std::set<int> reached(asset.order.begin(), asset.order.end());
  int lost = 0;
  while (reached.contains(lost)) ++lost;
  return Issue{"gltf.cycle", node_pointer(static_cast<std::size_t>(lost)),
               "the node is below itself, or below a node that is; allowed is a forest"};
}

}  // namespace

bool decompose(std::span<const double> m, Trs& out) {
  if (!last_row_is_affine(m)) return false;
  Axes axes;
  std::array<bool, 3> known{};
  for (std::size_t i = 0; i < 3; ++i) {
    axes[i] = Vec3(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
    const double length = std::sqrt(glm::dot(axes[i], axes[i]));
    out.scale[static_cast<int>(i)] = length;
    known[i] = length > 1e-12;
    if (known[i]) axes[i] /= length;
  }
  complete(axes, known);
  if (!are_perpendicular(axes)) return false;
  if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0.0) {
    axes[0] = -axes[0];
    out.scale.x = -out.scale.x;
  }
  out.translation = Vec3(m[12], m[13], m[14]);
  out.rotation = glm::normalize(glm::quat_cast(Mat3(axes[0], axes[1], axes[2])));
  return true;
}

Result<Done> read_nodes(const tinygltf::Model& model, Asset& asset) {
  std::vector<std::string> names;
  for (const tinygltf::Node& node : model.nodes) names.push_back(node.name);
  std::vector<std::string> labels = unique_labels(names);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Result<Trs> rest = read_transform(model.nodes[i], node_pointer(i));
    if (!rest) return rest.issue();
    asset.nodes.push_back({std::move(names[i]), std::move(labels[i]), -1, *rest, false});
  }
  if (const auto parents = read_parents(model, asset); !parents) return parents.issue();
  return read_order(model, asset);
}

}  // namespace contort
