#include "renders/scenery.h"

#include <algorithm>
#include <cmath>

#include "model/core/detmath.h"

namespace contort {
namespace {

constexpr Vec3 kSurfaceColor{0.49, 0.53, 0.59};  // The colour of level ground, as linear RGB.
constexpr Vec3 kNosingColor{0.05, 0.07, 0.11};
constexpr Vec3 kObstacleColor{0.30, 0.10, 0.46};  // Violet, which no part, highlight or ghost has.

// The greatest distance of the eye is 6 times half the figure's diagonal: 1.07 / 0.25 to fit it (camera.cpp), divided
// by 0.75 if the camera stands still. The ground fades out at 0.75 times that distance from the middle of the picture
// (renderer.cpp).
constexpr double kReachPerDiagonal = 0.75 * 6.0 / 2.0;

constexpr double kHardlyRises = 0.1;  // Height over length; 6 degrees.

// Height divided by length, toward the eye.
double rise_toward(const View& view, const Environment& environment, const Vec3& at_m, double radius_m) {
  const det::SinCos azimuth = det::sincos(view.azimuth_rad);
  const double x_m = radius_m * azimuth.sin, z_m = radius_m * azimuth.cos;
  const double near_m = environment.height_at(at_m.x + x_m, at_m.z + z_m);
  return (near_m - environment.height_at(at_m.x - x_m, at_m.z - z_m)) / (2.0 * radius_m);
}

struct Corners {
  Vec3 low{0.0}, high{0.0};
};

Corners corners_of(const std::vector<Vec3>& points) {
  if (points.empty()) return {};
  Corners corners{points.front(), points.front()};
  for (const Vec3& p : points) corners = {glm::min(corners.low, p), glm::max(corners.high, p)};
  return corners;
}

int add_mesh(std::vector<Triangles>& meshes, Triangles triangles) {
  meshes.push_back(std::move(triangles));
  return static_cast<int>(meshes.size()) - 1;
}

}  // namespace

GroundRegion region_around(std::span<const std::vector<Vec3>> outlines) {
  Corners all;
  double diagonal_m = 2.0;  // At least this, for a frame without a figure (see frame_points).
  bool first = true;
  for (const std::vector<Vec3>& points : outlines) {
    if (points.empty()) continue;
    const Corners corners = corners_of(points);
    all = first ? corners : Corners{glm::min(all.low, corners.low), glm::max(all.high, corners.high)};
    diagonal_m = std::max(diagonal_m, glm::distance(corners.low, corners.high));
    first = false;
  }
  const double margin_m = kReachPerDiagonal * diagonal_m;
  return {all.low.x - margin_m, all.low.z - margin_m, all.high.x + margin_m, all.high.z + margin_m};
}

std::vector<View> views_of(const Environment& environment, const Vec3& at_m, double radius_m) {
  std::vector<View> views = probe_views();
  const auto rise = [&](const View& view) { return rise_toward(view, environment, at_m, radius_m); };
  double steepest = 0.0;  // Views come in opposite pairs, so the greatest rise is not negative.
  for (const View& view : views) steepest = std::max(steepest, rise(view));
  const bool steps = std::holds_alternative<StepsGround>(environment.ground());
  const auto shows_rise = [&](const View& view) {
    const double share = rise(view) / steepest;  // On a plane, the sine of the angle between view and contour.
    return steps ? share < -0.25 : std::fabs(share) < 0.25;
  };
  if (steepest > kHardlyRises) std::stable_partition(views.begin(), views.end(), shows_rise);
  return views;
}

Scenery make_scenery(const Environment& environment, const GroundRegion& region, std::vector<Triangles>& meshes) {
  Scenery scenery;
  if (environment.is_level()) {
    scenery.level_m = environment.height_at(0.0, 0.0);
  } else {
    GroundMesh ground = ground_mesh(environment, region);
    scenery.ground = {
        {.mesh = add_mesh(meshes, std::move(ground.surface)), .world_from_mesh = {}, .color = kSurfaceColor},
        {.mesh = add_mesh(meshes, std::move(ground.nosings)), .world_from_mesh = {}, .color = kNosingColor}};
  }
  for (const ObstacleDesc& obstacle : environment.obstacles())
    scenery.obstacles.push_back({.mesh = add_mesh(meshes, tessellate(as_mesh(obstacle.shape))),
                                 .world_from_mesh = environment.world_from_environment(),
                                 .color = kObstacleColor,
                                 .ghost = true});
  return scenery;
}

}  // namespace contort
