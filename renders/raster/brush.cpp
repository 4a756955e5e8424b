#include "renders/raster/brush.h"

#include <GL/glcorearb.h>

#include <glm/gtc/type_ptr.hpp>

#include "renders/raster/matrices.h"
#include "renders/raster/shaders.h"
#include "renders/raster/uniforms.h"

namespace contort {

Result<Brush::Program> Brush::make(const char* vertex, const char* fragment) const {
  const Result<unsigned> id = make_program(gl_, vertex, fragment);
  if (!id) return id.issue();
  const auto location = [&](const char* name) { return gl_.GetUniformLocation(*id, name); };
  return Program{*id, location("world_from_mesh"), location("color"), location("rim")};
}

Result<Done> Brush::create() {
  const Result<Program> shaded = make(shaders::kSolidVertex, shaders::kSolidFragment);
  if (!shaded) return shaded.issue();
  shaded_ = *shaded;
  const Result<Program> flat = make(shaders::kFlatVertex, shaders::kFlatFragment);
  if (!flat) return flat.issue();
  flat_ = *flat;
  return Done{};
}

void Brush::destroy() {
  for (const unsigned program : {shaded_.id, flat_.id})
    if (program) gl_.DeleteProgram(program);
}

void Brush::begin_shaded(const Eye& eye) {
  begin(shaded_, eye.clip_from_world);
  set_vector(gl_, shaded_.id, "eye", eye.at);
  set_vector(gl_, shaded_.id, "to_light", eye.to_light);
}

void Brush::begin_flat(const glm::mat4& clip_from_world) { begin(flat_, clip_from_world); }

void Brush::begin(const Program& program, const glm::mat4& clip_from_world) {
  begun_ = &program;
  gl_.UseProgram(program.id);
  meshes_.bind();
  gl_.Enable(GL_CULL_FACE);  // Faces are counter-clockwise seen from outside; culling halves the work.
  set_matrix(gl_, program.id, "clip_from_world", clip_from_world);
}

void Brush::draw(const DrawInstance& instance, const Eye& eye, const Paint& paint) const {
  glm::mat4 world_from_mesh = float_matrix(instance.world_from_mesh, eye.center_m);
  if (paint.flatten) world_from_mesh = *paint.flatten * world_from_mesh;
  gl_.UniformMatrix4fv(begun_->place, 1, GL_FALSE, glm::value_ptr(world_from_mesh));
  set_color(gl_, begun_->color, paint.color ? *paint.color : instance.color, paint.alpha);
  gl_.Uniform1f(begun_->rim, paint.rim);  // No effect if the program has no such uniform.
  meshes_.draw(instance.mesh);
}

}  // namespace contort
