// A rigged model with the skinned meshes that move with it: the input of an import.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "model/asset/asset.h"

namespace contort {

inline constexpr std::size_t kInfluences = 8;  // joints on one vertex; further ones are not read

struct SkinnedVertex {
  Vec3 position{0.0};                         // in the mesh's own frame, to which joint_from_mesh applies
  std::array<int, kInfluences> joints{};      // indices into the skin's joints
  std::array<double, kInfluences> weights{};  // >= 0; their sum is 1, or 0 for a vertex without joints
  bool operator==(const SkinnedVertex&) const = default;
};

struct SkinnedMesh {
  int node = 0;
  int skin = 0;
  std::vector<SkinnedVertex> vertices;
  std::vector<int> indices;  // three to a triangle
  bool operator==(const SkinnedMesh&) const = default;
};

struct SkinnedAsset {
  Asset asset;
  std::vector<SkinnedMesh> meshes;      // one for each node with a mesh and a skin
  std::map<std::string, int> humanoid;  // nodes of VRM's bones, by name ("leftUpperArm"); empty without VRM
  bool operator==(const SkinnedAsset&) const = default;
};

}  // namespace contort
