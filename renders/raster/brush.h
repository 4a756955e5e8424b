// Draws instances of meshes with one of two programs: shaded, or in one flat colour.
#pragma once

#include <glm/mat4x4.hpp>

#include "model/core/result.h"
#include "renders/draw_list.h"
#include "renders/raster/eye.h"
#include "renders/raster/mesh_buffer.h"

namespace contort {

// The appearance of an instance, which may differ from its own colour.
struct Paint {
  float alpha = 1.0f;
  float rim = 1.0f;
  const glm::mat4* flatten = nullptr;  // Projects onto the ground, for shadows; null: no projection.
  const Vec3* color = nullptr;         // Replaces the instance's own colour; null: no replacement.
};

class Brush {
 public:
  Brush(const Gl& gl, const MeshBuffer& meshes) : gl_(gl), meshes_(meshes) {}
  Brush(const Brush&) = delete;
  Brush& operator=(const Brush&) = delete;

  // Call once, with the context current. Code: render.shader.
  Result<Done> create();
  void destroy();

  void begin_shaded(const Eye& eye);                  // Instances are shaded from now on.
  void begin_flat(const glm::mat4& clip_from_world);  // Instances have their plain colour from now on.
  void draw(const DrawInstance& instance, const Eye& eye, const Paint& paint = {}) const;

  // Draws the instances for which `is_meant` returns true, all with one paint.
  template <class Pick>
  void draw_all(std::span<const DrawInstance> instances, const Eye& eye, const Paint& paint, Pick is_meant) const {
    for (const DrawInstance& instance : instances)
      if (is_meant(instance)) draw(instance, eye, paint);
  }

 private:
  // A program that draws triangles, and the locations of its uniforms.
  struct Program {
    unsigned id = 0;
    int place = -1, color = -1, rim = -1;
  };
  Result<Program> make(const char* vertex, const char* fragment) const;
  void begin(const Program& program, const glm::mat4& clip_from_world);

  const Gl& gl_;
  const MeshBuffer& meshes_;
  Program shaded_, flat_;
  const Program* begun_ = nullptr;  // the program in use
};

}  // namespace contort
