#include "fuzz/figure_extent.h"

#include <algorithm>
#include <vector>

#include "model/core/index.h"
#include "model/geometry/solid_points.h"
#include "model/motion/kinematics.h"

namespace contort {

double extent_m(const Character& character, double side) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  double most_m = 0.0;
  for (const Collider& collider : character.colliders()) {
    const Solid solid = solid_of(collider);
    for (const Vec3& point : core_points(solid))
      most_m = std::max(most_m, side * (world[at(collider.joint)] * point).x + solid.radius_m);
  }
  return most_m;
}

}  // namespace contort
