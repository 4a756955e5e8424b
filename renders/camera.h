// The view from which a picture is taken. Plain geometry; the choice among several views is made in raster/auto_camera.
#pragma once

#include <span>
#include <vector>

#include "model/core/math.h"

namespace contort {

struct Camera {
  Vec3 eye_m{0.0, 1.0, 4.0};
  Vec3 right{1.0, 0.0, 0.0};  // Unit vectors at right angles, right x up = back.
  Vec3 up{0.0, 1.0, 0.0};
  Vec3 back{0.0, 0.0, 1.0};  // Opposite to the direction of view.
  double tan_half_height = 0.27;
  Vec3 center_m{0.0};  // The target: the middle of the framed points, on the axis of view.
};

// A direction of view. Azimuth 0 looks at the front of a character at rest (from +Z), positive from its left (+X);
// elevation is positive from above.
struct View {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};

// Returns the unit vector from the target towards the camera.
Vec3 towards_eye(const View& view);

// Returns the nearest camera in this direction that has all points in its picture, with a margin. `aspect` is width /
// height. Without points it shows two metres around the origin.
Camera frame_points(std::span<const Vec3> points, const View& view, double aspect);

// The camera of all frames of a strip. It stands still, unless the figure would then be less than three quarters as
// large in some frame; in that case it moves along with the figure. `points` must be in the picture of each frame;
// `anchors` are the positions of the figure on the ground.
struct StripCamera {
  Camera camera;
  bool follows = false;  // true: the camera keeps the distance from a frame's anchor that `camera` has from the origin.
  Camera at(const Vec3& anchor_m) const;
};
StripCamera frame_strip(std::span<const std::vector<Vec3>> points, std::span<const Vec3> anchors, const View& view,
                        double aspect);

Camera moved(Camera camera, const Vec3& by_m);

// Returns the view from an azimuth, at the common elevation.
View view_from(double azimuth_rad);

// Returns 12 azimuths, 30 degrees apart, in order of preference: from the front left corner outward.
std::vector<View> probe_views();

}  // namespace contort
