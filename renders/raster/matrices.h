// Makes transforms and projections for OpenGL: floats, relative to the camera's centre.
#pragma once

#include <glm/mat4x4.hpp>

#include "model/core/math.h"
#include "renders/camera.h"

namespace contort {

glm::mat4 float_matrix(const Rigid& place, const Vec3& origin_m);

// Returns the matrix from world coordinates relative to Camera::center_m to clip space; `aspect` is width / height.
glm::mat4 clip_matrix(const Camera& camera, double aspect);

// Returns the matrix that projects along the light onto the plane y = height.
glm::mat4 shadow_matrix(const Vec3& to_light, double height);

}  // namespace contort
