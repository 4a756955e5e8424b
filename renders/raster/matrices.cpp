#include "renders/raster/matrices.h"

#include <glm/gtc/quaternion.hpp>

namespace contort {

glm::mat4 float_matrix(const Rigid& place, const Vec3& origin_m) {
  glm::dmat4 matrix = glm::mat4_cast(place.q);
  matrix[3] = glm::dvec4(place.p_m - origin_m, 1.0);
  return glm::mat4(matrix);
}

glm::mat4 clip_matrix(const Camera& camera, double aspect) {
  const Vec3 eye = camera.eye_m - camera.center_m;
  // Near must be less than the clearance that camera.cpp keeps.
  const double near = 0.25, far = 4.0 * glm::length(eye) + 30.0;
  glm::dmat4 view(1.0);
  const Vec3 axes[] = {camera.right, camera.up, camera.back};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) view[column][row] = axes[row][column];
    view[3][row] = -glm::dot(axes[row], eye);
  }
  glm::dmat4 projection(0.0);
  projection[0][0] = 1.0 / (camera.tan_half_height * aspect);
  projection[1][1] = 1.0 / camera.tan_half_height;
  projection[2][2] = -(far + near) / (far - near);
  projection[2][3] = -1.0;
  projection[3][2] = -2.0 * far * near / (far - near);
  return glm::mat4(projection * view);
}

glm::mat4 shadow_matrix(const Vec3& to_light, double height) {
  glm::dmat4 matrix(1.0);
  matrix[1] = glm::dvec4(-to_light.x / to_light.y, 0.0, -to_light.z / to_light.y, 0.0);
  matrix[3] = glm::dvec4(to_light.x / to_light.y * height, height, to_light.z / to_light.y * height, 1.0);
  return glm::mat4(matrix);
}

}  // namespace contort
