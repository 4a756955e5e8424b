// Places vertices in the rest pose of the file.
#pragma once

#include <vector>

#include "import/figure.h"

namespace contort {

// Returns world_from_node of all nodes at rest, in the file's units.
std::vector<Mat4> world_of(const Asset& asset);

// The vertices of one mesh in the rest pose, and for each vertex the node of greatest weight; -1 for none.
struct PlacedMesh {
  std::vector<Vec3> positions;
  std::vector<int> owners;
};

PlacedMesh place(const SkinnedAsset& asset, const SkinnedMesh& mesh, const std::vector<Mat4>& world);

// A point on the triangles, with the node of greatest weight. Points are spread evenly, one for every `quantum` of
// area. Shapes are fitted to them, so that fine and coarse meshes give the same result.
struct SurfacePoint {
  Vec3 position{0.0};
  int owner = -1;
};
std::vector<SurfacePoint> spread_points(const SkinnedAsset& asset, const SkinnedMesh& mesh, const PlacedMesh& placed,
                                        double quantum);
double area_of(const SkinnedMesh& mesh, const PlacedMesh& placed);

// Returns the mesh of each bone: the triangles that it owns, in its own frame.
std::vector<TriangleMesh> bone_meshes(const SkinnedAsset& asset, const RiggedFigure& figure);

}  // namespace contort
