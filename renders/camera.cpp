#include "renders/camera.h"

#include <algorithm>
#include <limits>

#include "model/core/detmath.h"

namespace contort {
namespace {

constexpr double kTanHalfHeight = 0.25;  // 28 degrees: with a wider lens, limbs near the camera would look too large.
constexpr double kMargin = 1.07;         // Size of the picture relative to the figure.
constexpr double kClearance_m = 0.6;     // Least distance between the eye and the nearest point.
constexpr double kElevation_rad = 14.0 * kRadPerDeg;
constexpr double kFollowGain = 0.75;

// Along one picture axis with half-angle tangent t, a point (side, toward) is in the picture of an eye at (c, d) if
// |side - c| <= t * (d - toward). The nearest eye for all points touches both edges.
struct Fit {
  double center = 0.0;
  double distance = 0.0;
};

Fit fit_axis(std::span<const Vec3> points, const Vec3& side, const Vec3& back, double tangent) {
  double plus = -std::numeric_limits<double>::infinity(), minus = plus;
  for (const Vec3& p : points) {
    plus = std::max(plus, glm::dot(side, p) + tangent * glm::dot(back, p));
    minus = std::max(minus, -glm::dot(side, p) + tangent * glm::dot(back, p));
  }
  return {0.5 * (plus - minus), (plus + minus) / (2.0 * tangent)};
}

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double middle() const { return 0.5 * (low + high); }
};

Extent extent_along(std::span<const Vec3> points, const Vec3& axis) {
  Extent extent;
  for (const Vec3& p : points) {
    extent.low = std::min(extent.low, glm::dot(axis, p));
    extent.high = std::max(extent.high, glm::dot(axis, p));
  }
  return extent;
}

// The distance of the eye from the middle of the farthest frame, in which the figure is smallest.
double farthest(const Camera& camera, std::span<const std::vector<Vec3>> frames) {
  double distance = 0.0;
  for (const std::vector<Vec3>& points : frames)
    if (!points.empty())
      distance = std::max(distance, glm::dot(camera.back, camera.eye_m) - extent_along(points, camera.back).middle());
  return distance;
}

}  // namespace

Vec3 towards_eye(const View& view) {
  const det::SinCos azimuth = det::sincos(view.azimuth_rad), elevation = det::sincos(view.elevation_rad);
  return {azimuth.sin * elevation.cos, elevation.sin, azimuth.cos * elevation.cos};
}

Camera frame_points(std::span<const Vec3> points, const View& view, double aspect) {
  static constexpr Vec3 kNothing[] = {{-1, 0, -1}, {1, 2, 1}};
  if (points.empty()) points = kNothing;
  const det::SinCos azimuth = det::sincos(view.azimuth_rad);
  Camera camera;
  camera.tan_half_height = kTanHalfHeight;
  camera.right = Vec3(azimuth.cos, 0.0, -azimuth.sin);
  camera.back = towards_eye(view);
  camera.up = glm::cross(camera.back, camera.right);

  const double tan_y = kTanHalfHeight / kMargin, tan_x = tan_y * aspect;
  const Fit x = fit_axis(points, camera.right, camera.back, tan_x);
  const Fit y = fit_axis(points, camera.up, camera.back, tan_y);
  const Extent depth = extent_along(points, camera.back);
  const double distance = std::max({x.distance, y.distance, depth.high + kClearance_m});
  const Vec3 on_axis = x.center * camera.right + y.center * camera.up;
  camera.eye_m = on_axis + distance * camera.back;
  camera.center_m = on_axis + depth.middle() * camera.back;
  return camera;
}

StripCamera frame_strip(std::span<const std::vector<Vec3>> points, std::span<const Vec3> anchors, const View& view,
                        double aspect) {
  std::vector<std::vector<Vec3>> gathered(points.begin(), points.end());
  std::vector<Vec3> fixed, following;
  for (std::size_t i = 0; i < points.size(); ++i) {
    fixed.insert(fixed.end(), points[i].begin(), points[i].end());
    for (Vec3& p : gathered[i]) p -= anchors[i];
    following.insert(following.end(), gathered[i].begin(), gathered[i].end());
  }
  const Camera still = frame_points(fixed, view, aspect), moving = frame_points(following, view, aspect);
  if (farthest(moving, gathered) < kFollowGain * farthest(still, points)) return {moving, true};
  return {still, false};
}

Camera moved(Camera camera, const Vec3& by_m) {
  camera.eye_m += by_m;
  camera.center_m += by_m;
  return camera;
}

Camera StripCamera::at(const Vec3& anchor_m) const { return follows ? moved(camera, anchor_m) : camera; }

View view_from(double azimuth_rad) { return {azimuth_rad, kElevation_rad}; }

std::vector<View> probe_views() {
  std::vector<View> views;
  for (const int degrees : {30, -30, 60, -60, 0, 90, -90, 120, -120, 150, -150, 180})
    views.push_back(view_from(degrees * kRadPerDeg));
  return views;
}

}  // namespace contort
