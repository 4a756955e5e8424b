#include "model/geometry/solid_points.h"

namespace contort {

std::vector<Vec3> core_points(const Solid& solid) {
  if (solid.core == Solid::Core::point) return {solid.center_m};
  if (solid.core == Solid::Core::segment)
    return {solid.center_m - solid.half_length_m * solid.axis, solid.center_m + solid.half_length_m * solid.axis};
  std::vector<Vec3> corners;
  if (solid.core == Solid::Core::hull) {
    for (const Vec3& corner : solid.hull->corners_m) corners.push_back(solid.center_m + solid.axes * corner);
    return corners;
  }
  for (int i = 0; i < 8; ++i) {
    const Vec3 side((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    corners.push_back(solid.center_m + solid.axes * (side * solid.half_m));
  }
  return corners;
}

}  // namespace contort
