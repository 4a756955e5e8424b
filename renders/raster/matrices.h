// Places and projections as OpenGL wants them: floats, around the camera's centre.
#pragma once

#include <glm/mat4x4.hpp>

#include "model/core/math.h"
#include "renders/camera.h"

namespace contort {

glm::mat4 float_matrix(const Rigid& place, const Vec3& origin_m);

// From the world around Camera::center_m; `aspect` is width / height.
glm::mat4 clip_matrix(const Camera& camera, double aspect);

// Flattens along the light onto the plane y = height.
glm::mat4 shadow_matrix(const Vec3& to_light, double height);

}  // namespace contort
