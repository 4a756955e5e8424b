#include "renders/raster/shadow_map.h"

#include <GL/glcorearb.h>

#include <algorithm>

namespace contort {
namespace {

constexpr int kSide = 1024;  // Texels; 3 mm each for a human.

}  // namespace

Result<Done> ShadowMap::use() {
  if (!framebuffer_)
    if (Result<Done> made = create(); !made) return made;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, kSide, kSide);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  return Done{};
}

Result<Done> ShadowMap::create() {
  gl_.GenTextures(1, &texture_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, kSide, kSide, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
  const int parameters[][2] = {{GL_TEXTURE_MIN_FILTER, GL_LINEAR},
                               {GL_TEXTURE_MAG_FILTER, GL_LINEAR},
                               {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                               {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE},
                               {GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE},
                               {GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL}};
  for (const auto& p : parameters) gl_.TexParameteri(GL_TEXTURE_2D, static_cast<unsigned>(p[0]), p[1]);
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  gl_.DrawBuffer(GL_NONE);
  gl_.ReadBuffer(GL_NONE);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return Done{};
  return Issue{"render.framebuffer", "", "OpenGL cannot draw a shadow map (" + describe_gl(gl_) + ")."};
}

void ShadowMap::bind() const { gl_.BindTexture(GL_TEXTURE_2D, texture_); }

void ShadowMap::clear() {
  if (!framebuffer_) return;
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &texture_);
  framebuffer_ = 0;
}

glm::mat4 light_matrix(const Camera& camera, double aspect, const Vec3& to_light) {
  const double distance_m = glm::length(camera.eye_m - camera.center_m);
  // Reaches to the corner of the picture.
  const double half_m = 1.5 * distance_m * camera.tan_half_height * std::max(1.0, aspect);
  const Vec3 right = perpendicular(to_light);
  const Vec3 axes[] = {right, glm::cross(to_light, right), -to_light};
  glm::dmat4 matrix(1.0);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) matrix[column][row] = axes[row][column] / half_m;
  return glm::mat4(matrix);
}

}  // namespace contort
