#include "import/owned_surface.h"

#include <cmath>
#include <utility>

#include "import/skinning.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kSurfacePoints = 40000.0;  // points of a figure
constexpr std::size_t kFewPoints = 40;      // points of a node

using Points = std::vector<Vec3>;

struct MeshOfSkeleton {
  const SkinnedMesh* mesh;
  PlacedMesh placed;
};

bool is_in_reach(const Points& positions) {
  for (const Vec3& p : positions)
    for (int c = 0; c < 3; ++c)
      if (!(std::fabs(p[c]) <= kMaxModelCoordinate)) return false;
  return true;
}

void add_vertices(const PlacedMesh& placed, std::vector<Points>& by_node) {
  for (std::size_t i = 0; i < placed.positions.size(); ++i)
    if (placed.owners[i] >= 0) by_node[at(placed.owners[i])].push_back(placed.positions[i]);
}

// Small pieces have few points on their surface, so their vertices are added.
void take_vertices(const std::vector<Points>& vertices, OwnedSurface& out) {
  for (std::size_t node = 0; node < vertices.size(); ++node) {
    out.vertex_count += static_cast<int>(vertices[node].size());
    for (const Vec3& p : vertices[node]) out.box.add(p);
    Points& points = out.points[node];
    if (points.size() < kFewPoints) points.insert(points.end(), vertices[node].begin(), vertices[node].end());
  }
}

}  // namespace

Result<OwnedSurface> surface_of(const SkinnedAsset& asset, const std::vector<int>& skeletons, int skeleton,
                                const std::vector<Mat4>& world) {
  std::vector<MeshOfSkeleton> meshes;
  double area = 0.0;
  for (const SkinnedMesh& mesh : asset.meshes) {
    if (skeletons[at(mesh.skin)] != skeleton) continue;
    meshes.push_back({&mesh, place(asset, mesh, world)});
    if (!is_in_reach(meshes.back().placed.positions))
      return Issue{"import.too_large", "/meshes", "a vertex lies more than 1e6 from the origin, or nowhere"};
    area += area_of(mesh, meshes.back().placed);
  }
  OwnedSurface out{std::vector<Points>(asset.asset.nodes.size()), {}, 0};
  std::vector<Points> vertices(asset.asset.nodes.size());
  for (const auto& [mesh, placed] : meshes) {
    add_vertices(placed, vertices);
    if (!(area > 0.0)) continue;
    for (const SurfacePoint& p : spread_points(asset, *mesh, placed, area / kSurfacePoints))
      if (p.owner >= 0) out.points[at(p.owner)].push_back(p.position);
  }
  take_vertices(vertices, out);
  if (out.vertex_count > 0) return out;
  return Issue{"import.no_vertices", "/meshes", "no vertex follows the skin, so there is no surface to fit bodies to"};
}

}  // namespace contort
