#include "renders/skin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "renders/draw_list.h"

namespace contort {
namespace {

Mat4 matrix_of(const Trs& trs) {
  Mat4 matrix = Mat4(glm::mat3_cast(trs.rotation));
  for (int column = 0; column < 3; ++column) matrix[column] *= trs.scale[column];
  matrix[3] = glm::dvec4(trs.translation, 1.0);
  return matrix;
}

std::vector<Mat4> rest_of(const Asset& asset) {
  std::vector<Mat4> world(asset.nodes.size());
  for (const int node : asset.order) {
    const int parent = asset.nodes[at(node)].parent;
    const Mat4 own = matrix_of(asset.nodes[at(node)].rest);
    world[at(node)] = parent < 0 ? own : world[at(parent)] * own;
  }
  return world;
}

// Returns, by node, the joint of the character that carries it: its own, or that of the nearest ancestor; -1 for none.
std::vector<int> joints_of(const SkinDesc& desc, const Asset& asset, const Character& character) {
  std::vector<int> joints(asset.nodes.size(), -1);
  for (const int node : asset.order) {
    const AssetNode& own = asset.nodes[at(node)];
    if (own.parent >= 0) joints[at(node)] = joints[at(own.parent)];
    const auto named = desc.joints.find(own.label);
    if (named == desc.joints.end()) continue;
    if (const int joint = character.find_joint(named->second); joint >= 0) joints[at(node)] = joint;
  }
  return joints;
}

int root_node(const SkinDesc& desc, const Asset& asset) {
  for (const int node : asset.order) {
    const auto named = desc.joints.find(asset.nodes[at(node)].label);
    if (named != desc.joints.end() && named->second == "root") return node;
  }
  return -1;
}

class Tailor {
 public:
  Tailor(const SkinDesc& desc, const SkinnedAsset& asset, const Character& character, int root)
      : asset_(asset), joint_of_node_(joints_of(desc, asset.asset, character)), rest_(rest_of(asset.asset)) {
    std::vector<Rigid> world(character.joints().size());
    forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
    for (const Rigid& place : world) joint_from_world_.push_back(inverse(place));
    const Quat turn = from_rotation_vector(desc.rotation_deg * kRadPerDeg);
    const Mat3 scaled = glm::mat3_cast(character.rest_root().q * turn) * desc.metres_per_unit;
    world_from_model_ = Mat4(scaled);
    const Vec3 origin = character.rest_root().p_m - scaled * Vec3(rest_[at(root)][3]);
    world_from_model_[3] = glm::dvec4(origin, 1.0);
    skin_.moved.assign(world.size(), false);
  }

  Result<Skin> sew() {
    skin_.first.push_back(0);
    for (const SkinnedMesh& mesh : asset_.meshes)
      if (hangs_on_figure(mesh)) add(mesh);
    if (skin_.indices.empty()) return Issue{"skin.empty", "/joints", "no part of the model follows these joints"};
    if (skin_.owners.size() > kMostSkinTriangles)
      return Issue{"skin.too_large", "/model",
                   "found " + std::to_string(skin_.owners.size()) + " triangles, drawn are at most " +
                       std::to_string(kMostSkinTriangles)};
    return std::move(skin_);
  }

 private:
  bool hangs_on_figure(const SkinnedMesh& mesh) const {
    const std::vector<int>& nodes = asset_.asset.skins[at(mesh.skin)].joints;
    return std::any_of(nodes.begin(), nodes.end(), [&](int node) { return joint_of_node_[at(node)] >= 0; });
  }

  void add(const SkinnedMesh& mesh) {
    const AssetSkin& own = asset_.asset.skins[at(mesh.skin)];
    std::vector<Mat4> world_from_mesh;
    std::vector<int> joints;
    for (std::size_t j = 0; j < own.joints.size(); ++j) {
      world_from_mesh.push_back(world_from_model_ * rest_[at(own.joints[j])] * own.joint_from_mesh[j]);
      joints.push_back(std::max(0, joint_of_node_[at(own.joints[j])]));
    }
    const int base = static_cast<int>(skin_.first.size()) - 1;
    std::map<std::tuple<double, double, double>, int> seen;
    for (const SkinnedVertex& vertex : mesh.vertices) {
      const int index = static_cast<int>(skin_.first.size()) - 1;
      const Vec3& p = vertex.position;
      skin_.shared.push_back(seen.try_emplace({p.x, p.y, p.z}, index).first->second);
      add(vertex, world_from_mesh, joints);
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) add_triangle(base, &mesh.indices[i]);
  }

  // A vertex without joints follows the root.
  void add(const SkinnedVertex& vertex, const std::vector<Mat4>& world_from_mesh, const std::vector<int>& joints) {
    for (std::size_t i = 0; i < kInfluences; ++i) {
      if (!(vertex.weights[i] > 0.0)) continue;
      const int joint = joints[at(vertex.joints[i])];
      const Vec3 place(world_from_mesh[at(vertex.joints[i])] * glm::dvec4(vertex.position, 1.0));
      skin_.influences.push_back({joint, vertex.weights[i], joint_from_world_[at(joint)] * place});
    }
    if (static_cast<int>(skin_.influences.size()) == skin_.first.back())
      skin_.influences.push_back(
          {0, 1.0, joint_from_world_[0] * Vec3(world_from_model_ * glm::dvec4(vertex.position, 1.0))});
    skin_.first.push_back(static_cast<int>(skin_.influences.size()));
  }

  void add_triangle(int base, const int* corners) {
    std::map<int, double> weights;
    for (int k = 0; k < 3; ++k) {
      const int vertex = base + corners[k];
      skin_.indices.push_back(vertex);
      for (int i = skin_.first[at(vertex)]; i < skin_.first[at(vertex) + 1]; ++i)
        weights[skin_.influences[at(i)].joint] += skin_.influences[at(i)].weight;
    }
    const auto most = std::max_element(weights.begin(), weights.end(),
                                       [](const auto& l, const auto& r) { return l.second < r.second; });
    skin_.owners.push_back(most->first);
    skin_.moved[at(most->first)] = true;
  }

  const SkinnedAsset& asset_;
  std::vector<int> joint_of_node_;
  std::vector<Mat4> rest_;  // nodes at rest, in the model
  Mat4 world_from_model_;
  std::vector<Rigid> joint_from_world_;  // joints at rest
  Skin skin_;
};

std::vector<Vec3> posed_vertices(const Skin& skin, std::span<const Rigid> world) {
  std::vector<Mat3> turns;
  for (const Rigid& place : world) turns.push_back(glm::mat3_cast(place.q));
  std::vector<Vec3> positions_m;
  for (std::size_t v = 0; v + 1 < skin.first.size(); ++v) {
    Vec3 sum(0.0);
    for (int i = skin.first[v]; i < skin.first[v + 1]; ++i) {
      const Skin::Influence& own = skin.influences[at(i)];
      sum += own.weight * (turns[at(own.joint)] * own.point_m + world[at(own.joint)].p_m);
    }
    positions_m.push_back(sum);
  }
  return positions_m;
}

// Sums the normals of the triangles around each vertex, weighted by area. Vertices at one place share their normal.
std::vector<Vec3> vertex_normals(const Skin& skin, const std::vector<Vec3>& positions_m) {
  std::vector<Vec3> normals(positions_m.size(), Vec3(0.0));
  for (std::size_t i = 0; i + 2 < skin.indices.size(); i += 3) {
    const int* corner = &skin.indices[i];
    const Vec3& a = positions_m[at(corner[0])];
    const Vec3 across = glm::cross(positions_m[at(corner[1])] - a, positions_m[at(corner[2])] - a);
    for (int k = 0; k < 3; ++k) normals[at(skin.shared[at(corner[k])])] += across;
  }
  for (std::size_t v = 0; v < normals.size(); ++v) normals[v] = normals[at(skin.shared[v])];
  return normals;
}

bool is_near(const Vec3& p, const Vec3& origin_m) {
  const Vec3 away = glm::abs(p - origin_m);
  return away.x <= kWorldReach_m && away.y <= kWorldReach_m && away.z <= kWorldReach_m;  // false for NaN
}

}  // namespace

Result<Skin> bind_skin(const SkinDesc& desc, const SkinnedAsset& asset, const Character& character) {
  const int root = root_node(desc, asset.asset);
  if (root < 0) return Issue{"skin.other_model", "/joints", "the model has no node that stands for the root"};
  return Tailor(desc, asset, character, root).sew();
}

PosedSkin pose_skin(const Skin& skin, std::span<const Rigid> world, const std::vector<int>& group_of_joint) {
  PosedSkin posed{world.front().p_m, {}, true};
  const std::vector<Vec3> positions_m = posed_vertices(skin, world);
  const std::vector<Vec3> normals = vertex_normals(skin, positions_m);
  std::map<int, Triangles> pieces;
  for (std::size_t t = 0; t < skin.owners.size(); ++t) {
    const int* corner = &skin.indices[3 * t];
    const bool placed = is_near(positions_m[at(corner[0])], posed.origin_m) &&
                        is_near(positions_m[at(corner[1])], posed.origin_m) &&
                        is_near(positions_m[at(corner[2])], posed.origin_m);
    posed.complete = posed.complete && placed;
    if (!placed) continue;
    Triangles& piece = pieces[group_of_joint[at(skin.owners[t])]];
    for (int k = 0; k < 3; ++k) {
      piece.positions_m.push_back(positions_m[at(corner[k])] - posed.origin_m);
      piece.normals.push_back(unit_or(normals[at(corner[k])], Vec3(0, 1, 0)));
    }
  }
  for (auto& [group, triangles] : pieces) posed.pieces.push_back({group, std::move(triangles)});
  return posed;
}

}  // namespace contort
