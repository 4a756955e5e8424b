#include "generator/motion/foothold.h"

#include <algorithm>

#include "model/core/detmath.h"

namespace contort {

Vec3 footprint_point(const Leg& leg, int across, int lengthwise) {
  const double u = static_cast<double>(across) / (kAcross - 1);
  const double w = static_cast<double>(lengthwise) / (kLong - 1);
  return {leg.low_m.x + u * (leg.high_m.x - leg.low_m.x), 0.0, leg.low_m.z + w * (leg.high_m.z - leg.low_m.z)};
}

Foothold foothold_at(const Environment& environment, const Leg& leg, const Rigid& world_from_sole) {
  double heights[kAcross][kLong];
  Vec3 middle(0.0);
  double mean = 0.0;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kLong; ++j) {
      const Vec3 point = footprint_point(leg, i, j);
      const Vec3 at = world_from_sole * point;
      heights[i][j] = environment.height_at(at.x, at.z);
      mean += heights[i][j] / (kAcross * kLong);
      middle += point / static_cast<double>(kAcross * kLong);
    }
  double xx = 1e-12, zz = 1e-12, xh = 0.0, zh = 0.0;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kLong; ++j) {
      const Vec3 point = footprint_point(leg, i, j) - middle;
      xx += point.x * point.x, zz += point.z * point.z;
      xh += point.x * (heights[i][j] - mean), zh += point.z * (heights[i][j] - mean);
    }
  Foothold foothold;
  const double steepest = det::sin(kSteepestSole_rad) / det::cos(kSteepestSole_rad);
  foothold.slope_x = std::clamp(xh / xx, -steepest, steepest);
  foothold.slope_z = std::clamp(zh / zz, -steepest, steepest);
  // The plane is laid on the highest points, so that nothing is below the ground.
  double highest = -1e9, lowest = 1e9;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kLong; ++j) {
      const Vec3 point = footprint_point(leg, i, j);
      const double over = heights[i][j] - foothold.slope_x * point.x - foothold.slope_z * point.z;
      highest = std::max(highest, over), lowest = std::min(lowest, over);
    }
  foothold.height_m = highest;
  foothold.unevenness_m = highest - lowest;
  return foothold;
}

}  // namespace contort
