// Divides the surface of one skeleton among the nodes that move it.
#pragma once

#include <limits>
#include <vector>

#include "import/figure.h"
#include "model/core/result.h"

namespace contort {

inline constexpr double kMaxModelCoordinate = 1e6;  // greatest coordinate of vertices and joints, in the file's units

// The box around points; empty at first.
struct ModelBox {
  Vec3 low{std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity()};
  void add(const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  Vec3 size() const { return high - low; }
};

// The surface in the file's units, in the rest pose.
struct OwnedSurface {
  std::vector<std::vector<Vec3>> points;  // by node: the points on which this node has the greatest weight
  ModelBox box;                           // box around all vertices
  int vertex_count = 0;
};

// `skeletons` has the skeleton of each skin. Codes import.too_large, import.no_vertices.
Result<OwnedSurface> surface_of(const SkinnedAsset& asset, const std::vector<int>& skeletons, int skeleton,
                                const std::vector<Mat4>& world);

}  // namespace contort
