// obstacle_penetration: how far each body is from the nearest obstacle. Hands may press 5 mm into objects.
#include <algorithm>
#include <limits>

#include "checks/check.h"
#include "checks/fixed_limits.h"
#include "model/geometry/distance.h"

namespace contort {

namespace {

std::vector<Solid> placed_obstacles(const Environment& environment) {
  std::vector<Solid> solids;
  for (const ObstacleDesc& obstacle : environment.obstacles())
    solids.push_back(moved(environment.world_from_environment(), solid_of(obstacle.shape)));
  return solids;
}

// The distance to the nearest obstacle; infinite if none is within the band. NaN stays.
double clearance_m(const Solid& solid, std::span<const Solid> obstacles, double band_m) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Solid& obstacle : obstacles) {
    const Vec3 between = solid.center_m - obstacle.center_m;
    const double reach_m = solid.bound_m + obstacle.bound_m + band_m;
    if (glm::dot(between, between) > reach_m * reach_m) continue;
    const double distance_m = signed_distance(solid, obstacle, band_m);
    if (distance_m <= band_m && distance_m < least_m) least_m = distance_m;
    if (distance_m != distance_m) return distance_m;
  }
  return least_m;
}

}  // namespace

int obstacle_penetration_subject_count(const Character& character) {
  return static_cast<int>(character.bodies().size());
}

Subject obstacle_penetration_subject(const Character& character, int subject) {
  return {character.bodies()[static_cast<std::size_t>(subject)].name, "m"};
}

void obstacle_penetration_measure(const CheckInput& in, MarginFold& fold) {
  const std::vector<Solid> obstacles = placed_obstacles(in.environment);
  if (obstacles.empty()) return;
  fold.judged_all();
  std::vector<Solid> own;
  for (const Collider& collider : in.character.colliders()) own.push_back(solid_of(collider));
  std::vector<Solid> placed = own;
  const std::span<const Body> bodies = in.character.bodies();
  for (int frame = 0; frame < in.motion.frame_count; ++frame)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Rigid& world_from_body = in.world_at(frame)[static_cast<std::size_t>(bodies[b].joint)];
      double least_m = std::numeric_limits<double>::infinity();
      for (int c = 0; c < bodies[b].collider_count; ++c) {
        const auto i = static_cast<std::size_t>(bodies[b].first_collider + c);
        place(world_from_body, own[i], placed[i]);
        const double m = clearance_m(placed[i], obstacles, in.settings.collision_band_m);
        if (!(m >= least_m)) least_m = m;
        if (m != m) break;
      }
      if (least_m != std::numeric_limits<double>::infinity())
        fold.report(static_cast<int>(b), frame, least_m + kPress_m);
    }
}

}  // namespace contort
