// The camera in the form that shaders need.
#pragma once

#include <glm/mat4x4.hpp>

#include "model/core/math.h"
#include "renders/camera.h"

namespace contort {

struct Eye {
  Eye(const Camera& camera, int width, int height);

  glm::mat4 clip_from_world;
  Vec3 center_m, at, to_light;  // `at` is relative to the centre, m; `to_light` is a unit vector
  glm::mat4 light_from_world;
};

}  // namespace contort
