// Draws the sky behind a picture and the ground below its figures, each with its own programs.
#pragma once

#include "model/core/result.h"
#include "renders/draw_list.h"
#include "renders/raster/eye.h"
#include "renders/raster/mesh_buffer.h"
#include "renders/raster/shadow_map.h"

namespace contort {

class Backdrop {
 public:
  Backdrop(const Gl& gl, const MeshBuffer& meshes, const ShadowMap& shadows)
      : gl_(gl), meshes_(meshes), shadows_(shadows) {}
  Backdrop(const Backdrop&) = delete;
  Backdrop& operator=(const Backdrop&) = delete;

  // Call once, with the context current. Code: render.shader.
  Result<Done> create();
  void destroy();

  void draw_sky() const;
  // Draws a level plane if the ground has no shape. Without `show` it draws only depth.
  void draw_level(const DrawList& list, const Eye& eye, bool show) const;
  // Draws ground that has a shape, translucent, with the shadows of the shadow map. Leaves the depth mask off.
  void draw_shaped(const DrawList& list, const Eye& eye) const;

 private:
  void begin_ground(unsigned program, const DrawList& list, const Eye& eye, bool show) const;
  void draw_shaped_layer(const DrawList& list, const Eye& eye, bool show) const;

  const Gl& gl_;
  const MeshBuffer& meshes_;
  const ShadowMap& shadows_;
  unsigned sky_ = 0, level_ = 0, shaped_ = 0;  // programs
  unsigned no_vertices_ = 0;                   // OpenGL's core profile draws nothing unless a vertex array is bound,
                                               // even an empty one.
};

}  // namespace contort
