// The shadow that figures cast on uneven ground: the distance from the light to the nearest surface, as a texture.
#pragma once

#include <glm/mat4x4.hpp>

#include "renders/camera.h"
#include "renders/raster/gl.h"

namespace contort {

class ShadowMap {
 public:
  explicit ShadowMap(const Gl& gl) : gl_(gl) {}
  ~ShadowMap() { clear(); }
  ShadowMap(const ShadowMap&) = delete;
  ShadowMap& operator=(const ShadowMap&) = delete;

  // Clears it and makes it the target of drawing. Code: render.framebuffer.
  Result<Done> use();
  // Makes it the texture that shaders read.
  void bind() const;

 private:
  void clear();
  Result<Done> create();

  const Gl& gl_;
  unsigned framebuffer_ = 0;
  unsigned texture_ = 0;
};

// Returns the matrix from camera-centred world coordinates to a cube with sides from -1 to 1 around the visible
// scene, seen from the light. `to_light` is a unit vector.
glm::mat4 light_matrix(const Camera& camera, double aspect, const Vec3& to_light);

}  // namespace contort
