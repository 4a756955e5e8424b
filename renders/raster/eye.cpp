#include "renders/raster/eye.h"

#include "renders/raster/matrices.h"
#include "renders/raster/shadow_map.h"

namespace contort {

namespace {

// The light comes from above the camera's left shoulder, so all strips are lit alike and shadows fall away from the
// viewer.
Vec3 light_of(const Camera& camera) {
  return unit_or(1.1 * Vec3(0, 1, 0) + 0.65 * camera.back - 0.55 * camera.right, Vec3(0, 1, 0));
}

}  // namespace

Eye::Eye(const Camera& camera, int width, int height)
    : clip_from_world(clip_matrix(camera, static_cast<double>(width) / height)),
      center_m(camera.center_m),
      at(camera.eye_m - camera.center_m),
      to_light(light_of(camera)),
      light_from_world(light_matrix(camera, static_cast<double>(width) / height, to_light)) {}

}  // namespace contort
