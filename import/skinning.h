// Vertices where the rest pose of the file puts them.
#pragma once

#include <vector>

#include "import/figure.h"

namespace contort {

// world_from_node at rest, in the file's units.
std::vector<Mat4> world_of(const Asset& asset);

// The vertices of one mesh where the rest pose puts them, and the node that each hangs on most; -1 for none.
struct PlacedMesh {
  std::vector<Vec3> positions;
  std::vector<int> owners;
};

PlacedMesh place(const SkinnedAsset& asset, const SkinnedMesh& mesh, const std::vector<Mat4>& world);

// Points spread evenly over the triangles, with the node that each hangs on most: what fits should see, however finely
// or coarsely a part is drawn. One for every `quantum` of area.
struct SurfacePoint {
  Vec3 position{0.0};
  int owner = -1;
};
std::vector<SurfacePoint> spread_points(const SkinnedAsset& asset, const SkinnedMesh& mesh, const PlacedMesh& placed,
                                        double quantum);
double area_of(const SkinnedMesh& mesh, const PlacedMesh& placed);

// The mesh that is drawn of each bone: the triangles that it owns, in its own frame. By bone.
std::vector<TriangleMesh> bone_meshes(const SkinnedAsset& asset, const RiggedFigure& figure);

}  // namespace contort
