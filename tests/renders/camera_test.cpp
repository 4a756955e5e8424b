#include "renders/camera.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace contort {
namespace {

// Largest |coordinate| of a point in the picture: 1 is the edge.
double edge(const Camera& camera, double aspect, const Vec3& point) {
  const Vec3 seen = point - camera.eye_m;
  const double depth = -glm::dot(camera.back, seen);
  if (depth <= 0.0) return std::numeric_limits<double>::infinity();
  return std::max(std::fabs(glm::dot(camera.right, seen)) / (depth * camera.tan_half_height * aspect),
                  std::fabs(glm::dot(camera.up, seen)) / (depth * camera.tan_half_height));
}

double worst_edge(const Camera& camera, double aspect, const std::vector<Vec3>& points) {
  double worst = 0.0;
  for (const Vec3& p : points) worst = std::max(worst, edge(camera, aspect, p));
  return worst;
}

std::vector<Vec3> any_points() {
  const auto coordinates = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::tuple<int, int, int>>>(
      rc::gen::tuple(rc::gen::inRange(-3000, 3000), rc::gen::inRange(0, 3000), rc::gen::inRange(-3000, 3000))));
  std::vector<Vec3> points;
  for (const auto& [x, y, z] : coordinates) points.push_back(Vec3(x, y, z) * 1e-3);
  return points;
}

std::vector<Vec3> figure_at(double z_m) { return {{-0.4, 0, z_m - 0.3}, {0.4, 1.8, z_m + 0.3}, {0.4, 0, z_m}}; }

RC_GTEST_PROP(Camera, HasAllPointsInItsPictureAndNoneToSpare, ()) {
  const std::vector<Vec3> points = any_points();
  const View view = probe_views()[*rc::gen::inRange<std::size_t>(0, 12)];
  const double aspect = *rc::gen::element(0.5, 1.0, 4.0 / 3.0, 3.0);
  const Camera camera = frame_points(points, view, aspect);
  RC_ASSERT(worst_edge(camera, aspect, points) < 1.0);
  // The camera is as near as allowed: a point touches the margin, or has the least distance from the eye.
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) nearest = std::min(nearest, glm::dot(camera.back, camera.eye_m - p));
  RC_ASSERT(nearest > 0.59);
  RC_ASSERT(nearest < 0.61 || worst_edge(camera, aspect, points) > 0.9);
}

TEST(Camera, HasAxesAtRightAngles) {
  for (const View& view : probe_views()) {
    const Camera camera = frame_points({}, view, 1.0);
    EXPECT_NEAR(glm::dot(camera.right, camera.up), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(camera.up), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(glm::cross(camera.right, camera.up) - camera.back), 0.0, 1e-12);
    EXPECT_GT(camera.up.y, 0.9);
  }
}

TEST(Camera, LooksAtTheFrontFromAzimuthZero) {
  const Camera camera = frame_points({}, {0.0, 0.0}, 1.0);
  EXPECT_NEAR(camera.back.z, 1.0, 1e-12);
  EXPECT_NEAR(camera.right.x, 1.0, 1e-12);  // The character's left is at the right of the picture.
}

TEST(Camera, ProbesTwelveDifferentSides) {
  const std::vector<View> views = probe_views();
  ASSERT_EQ(views.size(), 12u);
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double turn = std::fabs(views[i].azimuth_rad - views[j].azimuth_rad);
      EXPECT_GT(std::min(turn, 2.0 * kPi - turn), 29.0 * kRadPerDeg);
    }
}

TEST(StripCamera, StandsStillForAFigureThatStays) {
  const std::vector<std::vector<Vec3>> frames = {figure_at(0.0), figure_at(0.2)};
  const std::vector<Vec3> anchors = {Vec3(0.0), Vec3(0.0, 0.0, 0.2)};
  EXPECT_FALSE(frame_strip(frames, anchors, probe_views()[0], 1.5).follows);
}

TEST(StripCamera, FollowsAFigureThatWalksAway) {
  const std::vector<std::vector<Vec3>> frames = {figure_at(0.0), figure_at(8.0)};
  const std::vector<Vec3> anchors = {Vec3(0.0), Vec3(0.0, 0.0, 8.0)};
  for (const View& view : probe_views()) {
    const StripCamera strip = frame_strip(frames, anchors, view, 1.5);
    ASSERT_TRUE(strip.follows) << view.azimuth_rad;
    for (std::size_t i = 0; i < frames.size(); ++i)
      EXPECT_LT(worst_edge(moved(strip.camera, anchors[i]), 1.5, frames[i]), 1.0);
  }
}

}  // namespace
}  // namespace contort
