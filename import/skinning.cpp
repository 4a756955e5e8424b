#include "import/skinning.h"

#include <algorithm>

#include "model/core/index.h"

namespace contort {

namespace {

Mat4 matrix_of(const Trs& trs) {
  const Mat3 turn = glm::mat3_cast(trs.rotation);
  Mat4 out(1.0);
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) out[c][r] = turn[c][r] * trs.scale[c];
  for (int r = 0; r < 3; ++r) out[3][r] = trs.translation[r];
  return out;
}

Vec3 point(const Mat4& m, const Vec3& p) { return Vec3(m[0]) * p.x + Vec3(m[1]) * p.y + Vec3(m[2]) * p.z + Vec3(m[3]); }

double area_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  return 0.5 * std::sqrt(glm::dot(normal, normal));
}

// The joint with the greatest sum of weights at a point of a triangle, where each corner counts by its share; -1 for
// none.
int owner_between(const SkinnedMesh& mesh, const int* corners, const Vec3& shares) {
  std::array<int, 3 * kInfluences> joints{};
  std::array<double, 3 * kInfluences> sums{};
  std::size_t count = 0;
  for (int k = 0; k < 3; ++k) {
    const SkinnedVertex& vertex = mesh.vertices[at(corners[k])];
    for (std::size_t i = 0; i < kInfluences; ++i) {
      if (!(vertex.weights[i] > 0.0)) continue;
      const auto end = joints.begin() + static_cast<std::ptrdiff_t>(count);
      const auto found = static_cast<std::size_t>(std::find(joints.begin(), end, vertex.joints[i]) - joints.begin());
      joints[found] = vertex.joints[i];
      sums[found] += shares[k] * vertex.weights[i];
      count = std::max(count, found + 1);
    }
  }
  const auto best = static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  return sums[best] > 0.0 ? joints[best] : -1;
}

}  // namespace

std::vector<Mat4> world_of(const Asset& asset) {
  std::vector<Mat4> world(asset.nodes.size());
  for (const int node : asset.order) {
    const AssetNode& own = asset.nodes[at(node)];
    const Mat4 local = matrix_of(own.rest);
    world[at(node)] = own.parent < 0 ? local : world[at(own.parent)] * local;
  }
  return world;
}

PlacedMesh place(const SkinnedAsset& asset, const SkinnedMesh& mesh, const std::vector<Mat4>& world) {
  const AssetSkin& skin = asset.asset.skins[at(mesh.skin)];
  std::vector<Mat4> world_from_mesh;
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
    world_from_mesh.push_back(world[at(skin.joints[j])] * skin.joint_from_mesh[j]);
  PlacedMesh out;
  for (const SkinnedVertex& vertex : mesh.vertices) {
    Vec3 sum(0.0);
    std::size_t best = 0;
    for (std::size_t i = 0; i < kInfluences; ++i) {
      if (vertex.weights[i] > 0.0)
        sum += vertex.weights[i] * point(world_from_mesh[at(vertex.joints[i])], vertex.position);
      if (vertex.weights[i] > vertex.weights[best]) best = i;
    }
    out.positions.push_back(sum);
    out.owners.push_back(vertex.weights[best] > 0.0 ? skin.joints[at(vertex.joints[best])] : -1);
  }
  return out;
}

double area_of(const SkinnedMesh& mesh, const PlacedMesh& placed) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    sum += area_of(placed.positions[at(mesh.indices[i])], placed.positions[at(mesh.indices[i + 1])],
                   placed.positions[at(mesh.indices[i + 2])]);
  return sum;
}

std::vector<SurfacePoint> spread_points(const SkinnedAsset& asset, const SkinnedMesh& mesh, const PlacedMesh& placed,
                                        double quantum) {
  const std::vector<int>& nodes = asset.asset.skins[at(mesh.skin)].joints;
  std::vector<SurfacePoint> out;
  double carried = 0.5 * quantum;  // area for which there is no point yet
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const int* corner = &mesh.indices[i];
    const Vec3 a = placed.positions[at(corner[0])], b = placed.positions[at(corner[1])],
               c = placed.positions[at(corner[2])];
    const double area = area_of(a, b, c);
    const int rows = std::max(1, static_cast<int>(std::ceil(std::sqrt(area / quantum))));
    // Divides the triangle into rows * rows small ones of equal size: some stand on their base, others on their tip.
    for (int row = 0; row < rows; ++row)
      for (int k = 0; k < 2 * row + 1; ++k) {
        carried += area / (static_cast<double>(rows) * rows);
        if (carried < quantum) continue;
        carried -= quantum;
        const bool tip = k % 2 == 1;
        const double along = (row + (tip ? 1.0 / 3.0 : 2.0 / 3.0)) / rows;
        const double across = (k / 2 + (tip ? 2.0 / 3.0 : 1.0 / 3.0)) / rows;
        const Vec3 shares(1.0 - along, along - across, across);
        const int owner = owner_between(mesh, corner, shares);
        out.push_back({shares.x * a + shares.y * b + shares.z * c, owner < 0 ? -1 : nodes[at(owner)]});
      }
  }
  return out;
}

std::vector<TriangleMesh> bone_meshes(const SkinnedAsset& asset, const RiggedFigure& figure) {
  std::vector<TriangleMesh> out(figure.bones.size());
  std::vector<int> bone_of(asset.asset.nodes.size(), -1);
  for (std::size_t b = 0; b < figure.bones.size(); ++b) bone_of[at(figure.bones[b].node)] = static_cast<int>(b);
  const std::vector<Mat4> world = world_of(asset.asset);
  const Vec3 origin = Vec3(world[at(figure.bones.front().node)][3]);
  for (const SkinnedMesh& mesh : asset.meshes) {
    const PlacedMesh placed = place(asset, mesh, world);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const int owner = placed.owners[at(mesh.indices[i])];
      const int bone = owner < 0 ? -1 : bone_of[at(owner)];
      if (bone < 0) continue;
      TriangleMesh& piece = out[at(bone)];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = placed.positions[at(mesh.indices[i + k])] - origin;
        piece.indices.push_back(static_cast<int>(piece.positions_m.size()));
        piece.positions_m.push_back(figure.world_from_model * (figure.metres_per_unit * p) -
                                    bone_at(figure, bone).position_m);
      }
    }
  }
  return out;
}

}  // namespace contort
