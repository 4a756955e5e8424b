// The convex hull of bearing points, seen from above.
#pragma once

#include <span>
#include <vector>

#include "model/core/math.h"

namespace contort {

// The hull's corners, counter-clockwise seen from above (+Y is Z cross X), as indices of the points, which are sorted.
void convex_hull(std::vector<Vec3>& points, std::vector<int>& hull);

// Scratch of nearest_inside, reused.
struct HullScratch {
  std::vector<int> order;
  std::vector<Vec3> hull, outline, cut;
};

// The point inside the hull of these points, at least `inset_m` from its edges, that is nearest to p seen from above; p
// itself if it is inside. The inset is reduced if the hull is too narrow. The result has p's height. There must be at
// least one point.
Vec3 nearest_inside(std::vector<Vec3>& points, double inset_m, const Vec3& p, HullScratch& scratch);

}  // namespace contort
